// SPDX-License-Identifier: BSD-3-Clause
// Simulated annealing against brute force and planted labellings.

#include <gtest/gtest.h>

#include "support/labeling_problems.h"
#include "support/planted_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling_tools.h"

namespace {

using namespace toposcope;

TEST(Annealing, SoundOnRandomProblemsAndNearlyAlwaysBest) {
  const auto labeler = test::labeler("annealing", {{"sweeps", "50"}, {"runs", "4"}});
  int solvable = 0, best = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const std::vector<Labeling> all = test::all_labelings(problem);
    const LabelingOutcome outcome = labeler->solve(problem, {.k_best = 1}, test::context());
    for (const Labeling& labeling : outcome.labelings) EXPECT_TRUE(meets_exclusions(problem, labeling.values)) << seed;
    if (all.empty()) continue;
    ++solvable;
    EXPECT_LE(outcome.lower_bound, all[0].cost + 1e-9) << seed;
    if (outcome.labelings.empty()) continue;
    EXPECT_GE(outcome.labelings[0].cost, all[0].cost) << seed;
    best += outcome.labelings[0].cost == all[0].cost;
  }
  EXPECT_GE(best, solvable * 99 / 100) << best << " of " << solvable;
}

TEST(Annealing, TheSameOnEveryRun) {
  const auto labeler = test::labeler("annealing", {{"sweeps", "20"}, {"runs", "2"}});
  const LabelingProblem problem = test::planted_problem({.features = 12, .candidates = 20, .structured = false}, 3);
  const LabelingOutcome once = labeler->solve(problem, {.k_best = 5, .time_limit_s = 100}, test::context());
  const LabelingOutcome again = labeler->solve(problem, {.k_best = 5, .time_limit_s = 100}, test::context(2));
  ASSERT_EQ(once.labelings.size(), again.labelings.size());
  for (std::size_t k = 0; k < once.labelings.size(); ++k)
    EXPECT_EQ(once.labelings[k].values, again.labelings[k].values);
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
