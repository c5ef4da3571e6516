// SPDX-License-Identifier: BSD-3-Clause
// toulbar2 against brute force, where the program is installed; what is said where it is not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "../../../plugins/labelers/toulbar2/solver_output.h"
#include "base/errors.h"
#include "support/labeling_problems.h"
#include "support/planted_problems.h"
#include "support/plugins.h"
#include "support/program.h"
#include "toposcope/labeling/tools.h"
#include "toposcope/system/programs.h"

namespace {

using namespace toposcope;

class Toulbar2 : public testing::Test {
 protected:
  void SetUp() override {
    if (!find_program("toulbar2")) GTEST_SKIP() << "SKIPPED: no toulbar2 here (apt-get install toulbar2)";
  }
};

TEST_F(Toulbar2, ProvesTheOptimumOfRandomProblems) {
  const auto labeler = test::labeler("toulbar2");
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const std::vector<Labeling> all = test::all_labelings(problem);
    const LabelingOutcome outcome = labeler->solve(problem, {}, test::context());
    EXPECT_TRUE(outcome.optimal) << seed;
    if (all.empty()) {
      EXPECT_EQ(outcome.lower_bound, forbidden) << seed;
      EXPECT_EQ(outcome.labelings.size(), all_missing(problem).size()) << seed;
      continue;
    }
    ASSERT_EQ(outcome.labelings.size(), 1U) << seed;
    EXPECT_NEAR(outcome.labelings[0].cost, all[0].cost, 1e-7) << seed;
    EXPECT_EQ(outcome.labelings[0].cost, cost_of(problem, outcome.labelings[0].values)) << seed;
    EXPECT_LE(outcome.lower_bound, all[0].cost) << seed;
    EXPECT_GE(outcome.lower_bound, all[0].cost - 1e-6) << seed;
  }
}

TEST_F(Toulbar2, StoppedItKeepsWhatItHas) {
  const LabelingProblem problem = test::planted_problem({.features = 40, .candidates = 60}, 1);
  for (const double limit_s : {1e-3, 0.5}) {
    const LabelingOutcome outcome =
        test::labeler("toulbar2")->solve(problem, {.time_limit_s = limit_s}, test::context());
    ASSERT_EQ(outcome.labelings.size(), 1U);
    EXPECT_TRUE(meets_exclusions(problem, outcome.labelings[0].values));
    EXPECT_LE(outcome.lower_bound, outcome.labelings[0].cost);
  }
}

TEST_F(Toulbar2, WithoutVariables) {
  LabelingProblem problem;
  problem.constant = 3;
  const LabelingOutcome outcome = test::labeler("toulbar2")->solve(problem, {}, test::context());
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_EQ(outcome.labelings[0].cost, 3);
}

TEST(Toulbar2Output, WhatWasPrintedBeforeTheEnd) {
  const LabelingProblem problem = test::queens(4);
  const std::string text =
      "Initial lower and upper bounds: [1.50, 40.00] 95%\nNew solution: 12.00 (0 backtracks, 4 nodes, depth 6)\n"
      " 1 3 0 2\nOptimality gap: [2.25, 12.00] 80 % (4 backtracks, 9 nodes)\nNew solution: 9.00 (1 back\n 2 0 3";
  const toulbar2::SolverOutput output = toulbar2::parse_output(text, problem);
  EXPECT_THAT(output.values, testing::ElementsAre(1, 3, 0, 2));  // the last line is cut short
  EXPECT_EQ(output.lower_bound, 2.25);
  EXPECT_FALSE(output.optimal);
  const toulbar2::SolverOutput whole =
      toulbar2::parse_output(text + " 1\nOptimum: 9.00 in 10 backtracks and 24 nodes ( 3 removals)\n", problem);
  EXPECT_THAT(whole.values, testing::ElementsAre(2, 0, 3, 1));
  EXPECT_TRUE(whole.optimal);
  EXPECT_EQ(whole.backtracks, 10U);
  EXPECT_EQ(whole.nodes, 24U);
}

/// A program of that name that states what its labelling does not cost.
TEST(Toulbar2Contradicting, IsNotTakenForProven) {
  const test::TemporaryFolder folder;
  LabelingProblem problem;
  problem.variables = {{.name = "a", .costs = {1, 3}, .optional = false}};
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder.path.string() + ":" + path).c_str(), 1);
  for (const auto& [stated, proven] :
       {std::pair("3.000", true), std::pair("2.000", false), std::pair("1.000", false)}) {
    test::write_text(folder / "toulbar2",
                     std::string("#!/bin/sh\nprintf 'New solution: 3 (0 backtracks)\\n 1\\nOptimum: ") + stated +
                         " in 0 backtracks and 1 nodes\\n'\n");
    std::filesystem::permissions(folder / "toulbar2", std::filesystem::perms::owner_all);
    const LabelingOutcome outcome = test::labeler("toulbar2")->solve(problem, {}, test::context());
    EXPECT_EQ(outcome.optimal, proven) << stated;
    ASSERT_EQ(outcome.labelings.size(), 1U);
    EXPECT_EQ(outcome.labelings[0].cost, 3);
    EXPECT_EQ(outcome.guarantee.find("states an optimum of") != std::string::npos, !proven) << outcome.guarantee;
  }
  setenv("PATH", path.c_str(), 1);
}

TEST(Toulbar2Absent, IsSaid) {
  const PluginManifest& manifest = test::host().catalog().require(PluginKind::labelers, "toulbar2");
  EXPECT_THAT(manifest.programs, testing::ElementsAre("toulbar2"));
  const std::string path = std::getenv("PATH");
  setenv("PATH", "relative:/nowhere", 1);
  EXPECT_EQ(missing_programs(manifest), "needs the program 'toulbar2' (apt-get install toulbar2)");
  std::string message;
  try {
    test::labeler("toulbar2");
  } catch (const PluginError& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(message, "plugin 'toulbar2': is not available: needs the program 'toulbar2' (apt-get install toulbar2)");
}

}  // namespace
