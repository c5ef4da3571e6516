// SPDX-License-Identifier: BSD-3-Clause
// Marginals and evidence against brute force, transfer matrices and trees.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling_tools.h"

namespace {

using namespace toposcope;

LabelingOutcome solve(const LabelingProblem& problem, const test::Settings& settings = {},
                      const LabelingRequest& request = {}) {
  return test::labeler("posterior", settings)->solve(problem, request, test::context());
}

void expect_exact(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& what) {
  SCOPED_TRACE(what);
  const std::vector<Labeling> all = test::all_labelings(problem);
  const test::BruteForce sums = test::sums(problem, all);
  if (all.empty()) {
    EXPECT_EQ(outcome.log_evidence, -forbidden);
    EXPECT_TRUE(outcome.posteriors.empty());
    EXPECT_EQ(outcome.labelings.size(), all_missing(problem).size());
    EXPECT_TRUE(outcome.optimal);
    EXPECT_EQ(outcome.lower_bound, forbidden);
    return;
  }
  EXPECT_NEAR(outcome.log_evidence, sums.log_evidence, 1e-9);
  ASSERT_EQ(outcome.posteriors.size(), sums.posteriors.size());
  for (std::size_t v = 0; v < sums.posteriors.size(); ++v) {
    ASSERT_EQ(outcome.posteriors[v].size(), sums.posteriors[v].size());
    for (std::size_t value = 0; value < sums.posteriors[v].size(); ++value)
      EXPECT_NEAR(outcome.posteriors[v][value], sums.posteriors[v][value], 1e-9) << v << " " << value;
  }
  EXPECT_TRUE(outcome.optimal);
  EXPECT_LE(outcome.lower_bound, all.front().cost);
  EXPECT_NEAR(outcome.lower_bound, all.front().cost, 1e-9);
  ASSERT_EQ(outcome.labelings.size(), std::min<std::size_t>(10, all.size()));
  for (std::size_t k = 0; k < outcome.labelings.size(); ++k) {
    EXPECT_EQ(outcome.labelings[k].values, all[k].values) << k;
    EXPECT_EQ(outcome.labelings[k].cost, all[k].cost) << k;
  }
}

TEST(Posterior, EliminationIsBruteForce) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    expect_exact(problem, solve(problem, {{"method", "elimination"}}), "seed " + std::to_string(seed));
    if (HasFailure()) break;
  }
}

}  // namespace
