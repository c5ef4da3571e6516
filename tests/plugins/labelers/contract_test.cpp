// SPDX-License-Identifier: BSD-3-Clause
// What every labeler owes, whichever it is: held against brute force and cut off at once on a large problem.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/run_context.h"
#include "support/labeling_problems.h"
#include "support/planted_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// All labelers of the build tree whose programs are there.
std::vector<std::string> labelers() {
  std::vector<std::string> ids;
  for (const PluginManifest* plugin : test::host().catalog().all(PluginKind::labelers))
    if (missing_programs(*plugin).empty()) ids.push_back(plugin->id);
  return ids;
}

void expect_sound(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& what) {
  for (const Labeling& labeling : outcome.labelings) {
    ASSERT_EQ(labeling.values.size(), problem.variables.size()) << what;
    for (Index v = 0; v < labeling.values.size(); ++v)
      ASSERT_LT(labeling.values[v], problem.variables[v].domain()) << what;
    EXPECT_TRUE(meets_exclusions(problem, labeling.values)) << what;
    EXPECT_EQ(labeling.cost, cost_of(problem, labeling.values)) << what;
    EXPECT_LE(outcome.lower_bound, labeling.cost + 1e-9 * (1 + std::abs(labeling.cost))) << what;
  }
  EXPECT_FALSE(outcome.guarantee.empty()) << what;
}

TEST(LabelerContract, EveryStrategyIsThere) {
  const std::vector<std::string> ids = labelers();
  for (const char* id :
       {"annealing", "backtracking", "continuous-relaxation", "discrete-relaxation", "least-error", "posterior"})
    EXPECT_NE(std::find(ids.begin(), ids.end(), id), ids.end()) << id;
}

/// A process for each problem is slow: the external program is held against fewer of them.
TEST(LabelerContract, EveryLabelerIsSoundOnRandomProblemsAndItsBoundBelowTheOptimum) {
  for (const std::string& id : labelers()) {
    const auto labeler =
        test::labeler(id, id == "annealing" ? test::Settings{{"sweeps", "20"}, {"runs", "2"}} : test::Settings{});
    const std::uint64_t problems = id == "toulbar2" ? 50 : 2000;
    for (std::uint64_t seed = 1; seed <= problems; ++seed) {
      const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
      const std::vector<Labeling> all = test::all_labelings(problem);
      const std::string what = id + ", seed " + std::to_string(seed);
      const LabelingOutcome outcome = labeler->solve(problem, {.k_best = 3, .time_limit_s = 600}, test::context());
      expect_sound(problem, outcome, what);
      if (all.empty()) continue;
      EXPECT_LE(outcome.lower_bound, all[0].cost + 1e-9 * (1 + std::abs(all[0].cost))) << what;
      bool may_be_empty = false;
      for (const LabelingVariable& variable : problem.variables) may_be_empty = may_be_empty || !variable.optional;
      EXPECT_TRUE(may_be_empty || !outcome.labelings.empty()) << what;
      if (::testing::Test::HasFailure()) return;
    }
  }
}

/// One that does not heed its limit never comes back from the random problem.
TEST(LabelerContract, EveryLabelerReturnsWhatItHasAfterAMillisecondOnTheLargestProblem) {
  for (const bool structured : {true, false}) {
    const LabelingProblem problem =
        test::planted_problem({.features = 40, .candidates = 60, .structured = structured}, 1);
    for (const std::string& id : labelers())
      for (const double limit_s : {0.0, 1e-3}) {
        const std::string what = id + ", " + (structured ? "planted, " : "random, ") + std::to_string(limit_s) + " s";
        const auto start = std::chrono::steady_clock::now();
        const LabelingOutcome outcome =
            test::labeler(id)->solve(problem, {.k_best = 10, .time_limit_s = limit_s}, test::context());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        expect_sound(problem, outcome, what);
        EXPECT_FALSE(outcome.labelings.empty()) << what << ": all features may be missing";
        RecordProperty(what, std::to_string(took.count()) + " s");
      }
  }
}

TEST(LabelerContract, EveryLabelerHeedsACancelledRunAndTheEmptyProblem) {
  const LabelingProblem problem = test::planted_problem({.features = 20, .candidates = 60}, 2);
  for (const std::string& id : labelers()) {
    RunContext cancelled(RunSettings{});
    cancelled.cancel();
    expect_sound(problem, test::labeler(id)->solve(problem, {}, cancelled), id + ", cancelled");
    const LabelingOutcome nothing = test::labeler(id)->solve({}, {}, test::context());
    expect_sound({}, nothing, id + ", empty");
    ASSERT_EQ(nothing.labelings.size(), 1U) << id;
  }
}

}  // namespace
}  // namespace toposcope
