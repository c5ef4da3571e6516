// SPDX-License-Identifier: BSD-3-Clause
// What every labeler owes, whichever it is: held against brute force and cut off at once on a large problem.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "base/run_context.h"
#include "support/labeler_checks.h"
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
      SCOPED_TRACE(id + ", seed " + std::to_string(seed));
      const LabelingOutcome outcome = labeler->solve(problem, {.k_best = 3, .time_limit_s = 600}, test::context());
      test::expect_sound(problem, outcome, all);
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
        SCOPED_TRACE(what);
        test::expect_sound(problem, outcome);
        EXPECT_FALSE(outcome.labelings.empty()) << "all features may be missing";
        RecordProperty(what, std::to_string(took.count()) + " s");
      }
  }
}

TEST(LabelerContract, EveryLabelerHeedsACancelledRunAndTheEmptyProblem) {
  const LabelingProblem problem = test::planted_problem({.features = 20, .candidates = 60}, 2);
  for (const std::string& id : labelers()) {
    RunContext cancelled(RunSettings{});
    cancelled.cancel();
    SCOPED_TRACE(id);
    test::expect_sound(problem, test::labeler(id)->solve(problem, {}, cancelled));
    const LabelingOutcome nothing = test::labeler(id)->solve({}, {}, test::context());
    test::expect_sound({}, nothing);
    ASSERT_EQ(nothing.labelings.size(), 1U);
  }
}

}  // namespace
}  // namespace toposcope
