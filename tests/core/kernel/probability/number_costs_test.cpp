// SPDX-License-Identifier: BSD-3-Clause
#include "probability/number_costs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace toposcope {
namespace {

double factorial(Index k) {
  return std::tgamma(k + 1.0);
}

/// One that may be missing is there or not with the same probability: what a feature without a count has, but for that
/// half.
TEST(NumberCosts, OfAtMostOneByHand) {
  const std::vector<double> costs = number_costs({0, 1}, 0.75, 0, 9);
  ASSERT_EQ(costs.size(), 2U);
  EXPECT_NEAR(costs[0], -std::log(0.5 + 0.5 * 0.25), 1e-12);
  EXPECT_NEAR(costs[1], -std::log(0.5 * 0.75), 1e-12);
}

TEST(NumberCosts, OfThreeByTheBinomialDistribution) {
  const std::vector<double> costs = number_costs({3, 3}, 0.9, 2, 9);
  const double found[] = {0.001, 3 * 0.9 * 0.01, 3 * 0.81 * 0.1, 0.729};
  ASSERT_EQ(costs.size(), 4U);
  for (Index k = 0; k < 4; ++k) EXPECT_NEAR(costs[k], -std::log(factorial(k) * found[k]) + 2.0 * (3 - k), 1e-12) << k;
}

/// The probabilities of finding each number sum to 1.
TEST(NumberCosts, AreAProbabilityDistribution) {
  const InstanceCount counts[] = {{0, 5}, {3, 8}, {0, std::nullopt}, {2, std::nullopt}};
  for (const InstanceCount& count : counts) {
    double sum = 0, tail = 0;
    const std::vector<double> costs = number_costs(count, 0.8, 0, 2000);
    for (Index k = 0; k < costs.size(); ++k) sum += std::exp(-costs[k] - std::lgamma(k + 1.0));
    if (!count.most) tail = 1.0 / 2000;  // of 1/((m + 1) (m + 2))
    EXPECT_NEAR(sum + tail, 1, 1e-3) << count.least;
  }
}

TEST(NumberCosts, NoMoreThanThereAreCandidates) {
  EXPECT_EQ(number_costs({0, std::nullopt}, 0.9, 0, 7).size(), 8U);
  EXPECT_EQ(number_costs({3, 8}, 0.9, 0, 2).size(), 3U);
}

}  // namespace
}  // namespace toposcope
