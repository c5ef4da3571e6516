// SPDX-License-Identifier: BSD-3-Clause
// Simulated annealing against brute force and planted labellings.

#include <gtest/gtest.h>

#include <algorithm>

#include "base/run_context.h"
#include "support/labeler_checks.h"
#include "support/labeling_problems.h"
#include "support/planted_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

TEST(Annealing, SoundOnRandomProblemsAndNearlyAlwaysBest) {
  const auto labeler = test::labeler("annealing", {{"sweeps", "50"}, {"runs", "4"}});
  int solvable = 0, best = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const std::vector<Labeling> all = test::all_labelings(problem);
    const LabelingOutcome outcome = labeler->solve(problem, {.k_best = 3}, test::context());
    SCOPED_TRACE(seed);
    solvable += !all.empty();
    best += test::expect_honest(problem, outcome, all);
  }
  EXPECT_GE(best, solvable * 99 / 100) << best << " of " << solvable;
}

TEST(Annealing, ReachesWhatWasPlanted) {
  for (const Index features : {20U, 40U}) {
    std::vector<Index> truth;
    const LabelingProblem problem = test::planted_problem({.features = features, .candidates = 60}, 1, &truth);
    const LabelingOutcome outcome = test::labeler("annealing", {{"sweeps", "200"}, {"runs", "3"}})
                                        ->solve(problem, {.k_best = 1, .time_limit_s = 600}, test::context());
    ASSERT_EQ(outcome.labelings.size(), 1U);
    EXPECT_LE(outcome.labelings[0].cost, cost_of(problem, truth));
  }
}

// Three variables share three candidates: from one permutation to another every single change breaks an exclusion.
TEST(Annealing, GetsPastExclusions) {
  LabelingProblem problem;
  problem.candidate_count = 3;
  for (Index c = 0; c < 3; ++c) set_conflict(problem, c, c);
  for (Index v = 0; v < 3; ++v) {
    problem.variables.push_back({.name = "f", .candidates = {0, 1, 2}, .costs = {1, 1, 1}, .optional = false});
    problem.variables[v].costs[(v + 1) % 3] = 0;
  }
  LabelingConstraint together = empty_constraint(problem, {0, 1, 2});
  std::fill(together.costs.begin(), together.costs.end(), 20);
  together.costs[table_entry(problem, together, std::vector<Index>{0, 1, 2})] = 5;
  together.costs[table_entry(problem, together, std::vector<Index>{1, 2, 0})] = 0;
  problem.constraints.push_back(together);
  const LabelingOutcome outcome = test::labeler("annealing")->solve(problem, {.k_best = 1}, test::context());
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_EQ(outcome.labelings[0].values, (std::vector<Index>{1, 2, 0}));
  EXPECT_TRUE(outcome.optimal);
}

TEST(Annealing, SolvesQueens) {
  for (const Index n : {1U, 4U, 8U, 30U, 60U}) {
    const LabelingOutcome outcome =
        test::labeler("annealing")->solve(test::queens(n), {.k_best = 1, .time_limit_s = 600}, test::context());
    ASSERT_EQ(outcome.labelings.size(), 1U) << n;
    EXPECT_EQ(outcome.labelings[0].cost, 0) << n;
    EXPECT_TRUE(outcome.optimal) << n;
  }
  const LabelingOutcome none = test::labeler("annealing")->solve(test::queens(3), {}, test::context());
  EXPECT_TRUE(none.labelings.empty());
  EXPECT_FALSE(none.optimal);                                                                    // it does not know
  EXPECT_TRUE(test::labeler("annealing")->solve(test::queens(2), {}, test::context()).optimal);  // one table says so
  const LabelingOutcome empty = test::labeler("annealing")->solve({}, {}, test::context());
  ASSERT_EQ(empty.labelings.size(), 1U);
  EXPECT_TRUE(empty.optimal);
}

TEST(Annealing, TheSameOnEveryRun) {
  const auto labeler = test::labeler("annealing", {{"sweeps", "20"}, {"runs", "2"}});
  const LabelingProblem problem = test::planted_problem({.features = 12, .candidates = 20, .structured = false}, 3);
  const LabelingOutcome once = labeler->solve(problem, {.k_best = 5, .time_limit_s = 100}, test::context());
  const LabelingOutcome again = labeler->solve(problem, {.k_best = 5, .time_limit_s = 100}, test::context(2));
  ASSERT_EQ(once.labelings.size(), again.labelings.size());
  for (std::size_t k = 0; k < once.labelings.size(); ++k)
    EXPECT_EQ(once.labelings[k].values, again.labelings[k].values);
  EXPECT_EQ(once.nodes, again.nodes);
  ASSERT_EQ(once.facts.size(), again.facts.size());
  for (std::size_t k = 0; k < once.facts.size(); ++k) EXPECT_EQ(once.facts[k].value, again.facts[k].value);
  RunSettings settings;
  settings.seed = 7;
  RunContext other(settings);
  EXPECT_NE(labeler->solve(problem, {.k_best = 5, .time_limit_s = 100}, other).nodes, once.nodes);
}

TEST(Annealing, OutOfTimeKeepsWhatItHas) {
  const LabelingProblem problem = test::planted_problem({.features = 40, .candidates = 60}, 1);
  const LabelingOutcome outcome =
      test::labeler("annealing")->solve(problem, {.k_best = 1, .time_limit_s = 1e-3}, test::context());
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_TRUE(meets_exclusions(problem, outcome.labelings[0].values));
  EXPECT_FALSE(outcome.optimal);
}

}  // namespace
