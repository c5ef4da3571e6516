// SPDX-License-Identifier: BSD-3-Clause
// Large problems: out of time, from coarse to fine, and the same on every run.

#include <gtest/gtest.h>

#include <numeric>

#include "posterior_fixture.h"
#include "support/labeler_checks.h"
#include "support/labeling_problems.h"

namespace {

using namespace toposcope;

LabelingProblem large(Index variables, Index candidates, int tables) {
  LabelingProblem problem;
  problem.candidate_count = 2 * candidates;
  std::uint64_t state = 1;
  const auto draw = [&] { return static_cast<double>((state = state * 6364136223846793005ULL + 1) >> 11) * 0x1p-53; };
  for (Index v = 0; v < variables; ++v) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "f" + std::to_string(v);
    variable.costs.push_back(2);
    for (Index k = 0; k < candidates; ++k) {
      variable.candidates.push_back(static_cast<Index>(draw() * problem.candidate_count));
      variable.costs.push_back(6 * draw() - 2);
    }
  }
  for (Index a = 0; a < problem.candidate_count; ++a) set_conflict(problem, a, a);
  for (Index v = 0; v < variables; ++v)
    for (Index w = v + 1; w < variables; ++w) {
      if (draw() * variables * (variables - 1) / 2 > tables) continue;
      LabelingConstraint constraint = empty_constraint(problem, {v, w});
      constraint.violations.clear();
      for (Index e = 0; e < constraint.costs.size(); ++e)
        if (e % (candidates + 1) != 0 && e > candidates) constraint.costs[e] = 6 * draw() - 2;
      problem.constraints.push_back(std::move(constraint));
    }
  return problem;
}

TEST(Posterior, TimeLimitAndCancelling) {
  const LabelingProblem problem = large(40, 59, 400);
  for (const char* method : {"auto", "elimination", "search", "belief-propagation"})
    for (const double limit_s : {0.0, 0.001, 0.02, 0.3}) {
      const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", method}}, {.time_limit_s = limit_s});
      SCOPED_TRACE(method + std::to_string(limit_s) + outcome.guarantee);
      ASSERT_FALSE(outcome.labelings.empty());
      test::expect_sound(problem, outcome);
      EXPECT_FALSE(outcome.optimal);
      for (const std::vector<double>& posterior : outcome.posteriors)
        EXPECT_NEAR(std::accumulate(posterior.begin(), posterior.end(), 0.0), 1, 1e-9);
    }
}

// More nodes than are tried at once: sums are made from coarse to fine, and each states its error.
TEST(Posterior, SumsFromCoarseToFineHoldWhatTheyState) {
  const LabelingProblem problem = large(7, 9, 12);
  const LabelingOutcome exact = test::solve_posterior(problem, {{"method", "elimination"}});
  ASSERT_EQ(exact.guarantee.substr(0, 5), "exact");
  for (const double limit_s : {0.05, 0.2, 0.8, 60.0}) {
    const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", "search"}}, {.time_limit_s = limit_s});
    SCOPED_TRACE(std::to_string(limit_s) + " s: " + outcome.guarantee);
    EXPECT_LE(outcome.lower_bound, exact.labelings.front().cost);
    if (test::fact(outcome, "method") != "search") continue;  // out of time before the first
    const double stated = std::stod(test::fact(outcome, "left out")) * 1.01 + 1e-11;
    EXPECT_EQ(outcome.guarantee.substr(0, 5), stated < 2e-11 ? "exact" : "stopp");
    EXPECT_NEAR(outcome.log_evidence, exact.log_evidence, 1.2 * stated);
    test::expect_posteriors(outcome, exact.posteriors, stated);
    EXPECT_EQ(outcome.labelings.front().values, exact.labelings.front().values);
  }
}

// A table of all values for each variable: half a gigabyte is more than a search that will not end is given.
TEST(Posterior, ASearchThatNeedsTooMuchMemoryIsNotBegun) {
  const Index side = 60;
  LabelingProblem grid;
  for (Index v = 0; v < side * side; ++v) {
    LabelingVariable& variable = grid.variables.emplace_back();
    variable.name = "x" + std::to_string(v);
    variable.optional = false;
    variable.costs = {0, 0.1 * (v % 3)};
  }
  for (Index v = 0; v < side * side; ++v)
    for (const Index w : {v % side + 1 < side ? v + 1 : v, v + side}) {
      if (w == v || w >= side * side) continue;
      LabelingConstraint constraint = empty_constraint(grid, {v, w});
      constraint.violations.clear();
      constraint.costs = {0, 0.5, 0.5, 0};
      grid.constraints.push_back(std::move(constraint));
    }
  const LabelingOutcome outcome = test::solve_posterior(grid, {}, {.time_limit_s = 20});
  EXPECT_EQ(test::fact(outcome, "search").substr(0, 10), "would need") << outcome.guarantee;
  EXPECT_EQ(test::fact(outcome, "method"), "belief propagation");
  EXPECT_EQ(outcome.posterior_exactness, Exactness::approximate);
}

TEST(Posterior, SameAnswerEveryRun) {
  const LabelingProblem problem = large(6, 9, 9);
  for (const char* method : {"auto", "elimination", "search", "belief-propagation"}) {
    const LabelingOutcome a = test::solve_posterior(problem, {{"method", method}, {"max_entries", "1e9"}});
    const LabelingOutcome b = test::solve_posterior(problem, {{"method", method}, {"max_entries", "1e9"}});
    EXPECT_EQ(a.log_evidence, b.log_evidence) << method;
    EXPECT_EQ(a.posteriors, b.posteriors) << method;
    EXPECT_EQ(a.labelings.front().values, b.labelings.front().values) << method;
  }
}

}  // namespace
