// SPDX-License-Identifier: BSD-3-Clause
// Backtracking on the dissertation's worked example and the queens, and where it is stopped.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/run_context.h"
#include "support/labeler_checks.h"
#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

TEST(Backtracking, QueensAreCountedAndRelaxationVisitsFewerNodes) {
  const std::map<Index, std::string> solutions = {{8, "92"}, {10, "724"}, {12, "14200"}};
  for (const auto& [n, count] : solutions) {
    std::map<std::string, std::uint64_t> nodes;
    for (const char* backjumping : {"true", "false"})
      for (const char* relaxation : {"none", "before", "maintained"}) {
        const LabelingOutcome outcome = test::labeler("backtracking", {{"find", "count"},
                                                                       {"relaxation", relaxation},
                                                                       {"order", "smallest-domain"},
                                                                       {"backjumping", backjumping}})
                                            ->solve(test::queens(n), {1, 600}, test::context());
        EXPECT_EQ(test::fact(outcome, "consistent labellings"), count);
        EXPECT_TRUE(outcome.optimal);
        std::printf("%2u queens, relaxation %-10s, backjumping %-5s: %s solutions, %lu nodes\n", n, relaxation,
                    backjumping, count.c_str(), static_cast<unsigned long>(outcome.nodes));
        nodes[std::string(relaxation) + backjumping] = outcome.nodes;
      }
    for (const std::string backjumping : {"true", "false"}) {
      EXPECT_LT(nodes["maintained" + backjumping], nodes["none" + backjumping]);
      EXPECT_LE(nodes["before" + backjumping], nodes["none" + backjumping]);
    }
    for (const std::string relaxation : {"none", "before", "maintained"})
      EXPECT_LE(nodes[relaxation + "true"], nodes[relaxation + "false"]);
  }
}

// Figure 3.6 and Table 3.1: three features, four working sets, of which w4 is noise.
LabelingProblem worked_example() {
  LabelingProblem problem;
  problem.candidate_count = 4;
  for (Index w = 0; w < 4; ++w) set_conflict(problem, w, w);
  for (const auto& [name, detectability] : {std::pair{"f1", 1.0}, {"f2", 0.75}, {"f3", 0.9}})
    problem.variables.push_back({name, detectability, {0, 1, 2, 3}, {3, 0, 0, 0, 0}});
  const auto relate = [&](const char* name, Index f, Index g, std::vector<std::pair<Index, Index>> pairs) {
    LabelingConstraint constraint = empty_constraint(problem, {f, g});
    constraint.name = name;
    for (Index v = 1; v <= 4; ++v)
      for (Index w = 1; w <= 4; ++w) constraint.violations[5 * v + w] = 2;
    for (const auto& [v, w] : pairs) constraint.violations[5 * v + w] = constraint.violations[5 * w + v] = 0.5F;
    problem.constraints.push_back(constraint);
  };
  relate("r1", 0, 2, {{1, 3}, {1, 4}, {3, 4}});
  relate("r2", 0, 1, {{1, 2}, {2, 3}});
  relate("r3", 1, 2, {{2, 3}, {3, 4}});
  return problem;
}

TEST(Backtracking, WorkedExampleOfTheDissertation) {
  for (const char* find : {"first", "all", "count"}) {
    const LabelingOutcome outcome =
        test::labeler("backtracking", {{"find", find}})->solve(worked_example(), {50, 60}, test::context());
    ASSERT_EQ(outcome.labelings.size(), 1U);  // the only one without a missing feature
    EXPECT_EQ(outcome.labelings[0].values, (std::vector<Index>{1, 2, 3}));
    EXPECT_EQ(test::fact(outcome, "fewest missing"), "0");
  }
}

TEST(Backtracking, ThreeQueensCannotAllStand) {
  LabelingProblem problem = test::queens(3);
  LabelingOutcome outcome = test::labeler("backtracking")->solve(problem, {}, test::context());
  EXPECT_TRUE(outcome.labelings.empty());
  EXPECT_TRUE(outcome.optimal);
  EXPECT_EQ(outcome.lower_bound, forbidden);
  EXPECT_EQ(test::fact(outcome, "consistent labellings"), "0");
  EXPECT_EQ(test::fact(outcome, "smallest conflicting set"), "'rows 0 and 1', 'rows 0 and 2' and 'rows 1 and 2'");
}

TEST(Backtracking, TellsWhyAFeatureMustBeMissing) {
  LabelingProblem problem = worked_example();
  problem.constraints[0].violations[5 * 1 + 3] = 2;  // f1 = w1, f3 = w3 no longer meet r1
  for (const char* id : {"backtracking", "discrete-relaxation"}) {
    const LabelingOutcome outcome = test::labeler(id)->solve(problem, {}, test::context());
    EXPECT_EQ(test::fact(outcome, "smallest conflicting set"),
              "'r1', 'r2', 'r3', the exclusion of 'f1' and 'f2' and the exclusion of 'f1' and 'f3'");
    EXPECT_EQ(std::count(outcome.labelings[0].values.begin(), outcome.labelings[0].values.end(), Index{0}), 1);
  }
}

LabelingProblem large_problem(int variables, int domain) {
  return test::random_problem(
      {.variables = variables, .domain = domain, .arity = 2, .constraints = variables * 10, .forbidden_entries = 0.3},
      7);
}

TEST(Backtracking, StoppedKeepsAValidLabelling) {
  const LabelingProblem problem = large_problem(40, 60);
  for (const char* find : {"first", "all", "count"})
    for (const double limit_s : {0.0, 1e-3, 0.01}) {
      const LabelingOutcome outcome =
          test::labeler("backtracking", {{"find", find}})->solve(problem, {10, limit_s}, test::context());
      ASSERT_FALSE(outcome.labelings.empty());
      EXPECT_TRUE(meets_exclusions(problem, outcome.labelings[0].values));
      EXPECT_EQ(outcome.labelings[0].cost, cost_of(problem, outcome.labelings[0].values));
      if (limit_s > 0) continue;
      EXPECT_FALSE(outcome.optimal);
      EXPECT_NE(outcome.guarantee.find("stopped"), std::string::npos) << outcome.guarantee;
    }
}

TEST(Backtracking, CancelledReturnsAtOnce) {
  RunContext context;
  context.cancel();
  const LabelingProblem problem = large_problem(20, 30);
  const LabelingOutcome outcome = test::labeler("backtracking")->solve(problem, {}, context);
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_EQ(outcome.labelings[0].values, all_missing(problem)[0].values);
  EXPECT_FALSE(outcome.optimal);
}

TEST(Backtracking, ProblemWithoutVariables) {
  LabelingProblem problem;
  problem.constant = 3;
  const LabelingOutcome outcome = test::labeler("backtracking")->solve(problem, {}, test::context());
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_EQ(outcome.labelings[0].cost, 3);
  EXPECT_EQ(outcome.lower_bound, 3);
}

TEST(Backtracking, RefusesTablesThatDoNotFit) {
  LabelingProblem problem = worked_example();
  problem.constraints[1].costs.pop_back();
  EXPECT_ANY_THROW(test::labeler("backtracking")->solve(problem, {}, test::context()));
}

}  // namespace
