// SPDX-License-Identifier: BSD-3-Clause
#include "learn/predictive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace toposcope {
namespace {

/// So many of the next ones lie within as are promised, however few there were.
TEST(Predictive, IntervalsHoldTheNextAsOftenAsTheySay) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const std::size_t n : {3U, 5U, 12U})
    for (const double coverage : {0.8, 0.95}) {
      constexpr int draws = 20000;
      int held = 0;
      for (int i = 0; i < draws; ++i) {
        std::vector<double> values;
        for (std::size_t k = 0; k < n; ++k) values.push_back(4 * std::exp(0.2 * normal(random)));
        const PredictiveInterval interval = predict(values, coverage);
        const double next = 4 * std::exp(0.2 * normal(random));
        held += next > interval.low && next < interval.high;
      }
      // Spreads below the least are widened: a little more is held of few.
      EXPECT_GE(static_cast<double>(held) / draws, coverage - 0.01) << n;
      EXPECT_LE(static_cast<double>(held) / draws, coverage + 0.02) << n;
    }
}

TEST(Predictive, KnownQuantiles) {
  // t of 2 degrees of freedom at 97.5 % is 4.3027; spread 0.1 about 1.
  const std::vector<double> three = {std::exp(-0.1), 1, std::exp(0.1)};
  EXPECT_NEAR(std::log(predict(three, 0.95).high), 4.3027 * 0.1 * std::sqrt(4.0 / 3), 1e-4);
  EXPECT_NEAR(std::log(predict(three, 0.95).low), -4.3027 * 0.1 * std::sqrt(4.0 / 3), 1e-4);
  // Of 3 degrees it is 3.1824.
  EXPECT_NEAR(predict_deviation(std::vector<double>{1, 2, 2}, 0.95), 3.1824 * std::sqrt(3.0), 1e-3);
}

TEST(Predictive, AFewAlikeAreNotAllAlikeAndOneSaysLittle) {
  const std::vector<double> alike = {5, 5, 5}, one = {5};
  EXPECT_GT(predict(alike, 0.95).high, 5.4);
  EXPECT_NEAR(predict(one, 0.95).high, 15, 1e-9);
  EXPECT_NEAR(predict(one, 0.95).low, 5.0 / 3, 1e-9);
  const std::vector<double> wild = {1, 100};
  EXPECT_NEAR(predict(wild, 0.95).high / predict(wild, 0.95).low, 9, 1e-9);
}

TEST(Predictive, SharesAreNeverCertain) {
  EXPECT_NEAR(predict_share(3, 3), 0.8, 1e-12);
  EXPECT_NEAR(predict_share(0, 3), 0.2, 1e-12);
  EXPECT_NEAR(predict_share(0, 0), 0.5, 1e-12);
}

}  // namespace
}  // namespace toposcope
