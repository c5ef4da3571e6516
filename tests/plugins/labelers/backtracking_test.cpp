// SPDX-License-Identifier: BSD-3-Clause
// Backtracking against listing by `consistent`, the dissertation's worked example, and the queens.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/run_context.h"
#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

struct Listed {
  Index missing = 0;
  double violation = 0;
  Labeling labeling;
};

std::vector<Listed> all_consistent(const LabelingProblem& problem) {
  std::vector<Listed> all;
  for (const Labeling& labeling : test::all_labelings(problem)) {
    if (!consistent(problem, labeling.values)) continue;
    Listed listed{0, 0, labeling};
    for (Index v = 0; v < labeling.values.size(); ++v)
      listed.missing += problem.variables[v].missing(labeling.values[v]);
    for (const LabelingConstraint& constraint : problem.constraints) {
      bool untested = false;
      for (const Index v : constraint.scope) untested = untested || problem.variables[v].missing(labeling.values[v]);
      if (untested)
        listed.violation += 1;
      else if (!constraint.violations.empty())
        listed.violation += constraint.violations[table_entry(problem, constraint, labeling.values)];
    }
    all.push_back(listed);
  }
  return all;
}

std::string fact(const LabelingOutcome& outcome, std::string_view name) {
  for (const LabelingFact& fact : outcome.facts)
    if (fact.name == name) return fact.value;
  return "";
}

struct Mode {
  const char *missing, *rank, *relaxation, *order;
  bool backjumping;
  double within;
};

Mode mode_of(std::uint64_t seed) {
  const char* missing[] = {"only-if-needed", "allowed", "never"};
  const char* rank[] = {"violation", "cost"};
  const char* relaxation[] = {"none", "before", "maintained"};
  const char* order[] = {"weighted", "smallest-domain", "detectability"};
  return {missing[seed % 3],    rank[seed / 3 % 2], relaxation[seed / 6 % 3],
          order[seed / 18 % 3], seed / 54 % 2 == 0, seed % 5 == 0 ? 1.5 : forbidden};
}

LabelingOutcome solve(const LabelingProblem& problem, const Mode& mode, const char* find, std::size_t k_best) {
  return test::labeler("backtracking", {{"find", find},
                                        {"missing", mode.missing},
                                        {"rank", mode.rank},
                                        {"relaxation", mode.relaxation},
                                        {"order", mode.order},
                                        {"backjumping", mode.backjumping ? "true" : "false"}})
      ->solve(problem, {k_best, 60, mode.within}, test::context());
}

void expect_as_listed(const LabelingProblem& problem, const Mode& mode) {
  std::vector<Listed> all = all_consistent(problem);
  const std::string missing = mode.missing;
  const bool by_violation = std::string(mode.rank) == "violation";
  Index fewest = no_candidate;
  for (const Listed& listed : all) fewest = std::min(fewest, listed.missing);
  std::erase_if(all, [&](const Listed& listed) {
    return (missing == "never" && listed.missing > 0) || (missing == "only-if-needed" && listed.missing > fewest);
  });
  std::sort(all.begin(), all.end(), [&](const Listed& a, const Listed& b) {
    return std::make_tuple(by_violation ? a.violation : 0, a.labeling.cost, a.labeling.values) <
           std::make_tuple(by_violation ? b.violation : 0, b.labeling.cost, b.labeling.values);
  });
  constexpr std::size_t k_best = 7;
  const std::vector<Labeling> finite = test::all_labelings(problem);
  const double least = finite.empty() ? forbidden : finite[0].cost;
  for (const char* find : {"all", "count"}) {
    const LabelingOutcome outcome = solve(problem, mode, find, k_best);
    if (std::string(find) == "count" || all.empty()) {
      ASSERT_EQ(fact(outcome, "consistent labellings"), std::to_string(all.size()));
    }
    if (all.empty()) {
      EXPECT_EQ(outcome.labelings.size(), all_missing(problem).size());
      EXPECT_EQ(outcome.optimal, outcome.labelings.empty());
      EXPECT_LE(outcome.lower_bound, least);
      continue;
    }
    EXPECT_TRUE(outcome.optimal);
    if (missing == "only-if-needed") {
      EXPECT_EQ(fact(outcome, "fewest missing"), std::to_string(fewest));
    }
    std::vector<Labeling> expected;
    for (const Listed& listed : all)
      if (expected.size() < k_best && listed.labeling.cost <= all[0].labeling.cost + mode.within)
        expected.push_back(listed.labeling);
    ASSERT_EQ(outcome.labelings.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(outcome.labelings[i].values, expected[i].values) << "rank " << i;
      EXPECT_EQ(outcome.labelings[i].cost, expected[i].cost);
    }
  }
  const LabelingOutcome first = solve(problem, mode, "first", k_best);
  if (all.empty()) return;
  ASSERT_EQ(first.labelings.size(), 1U);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                          [&](const Listed& listed) { return listed.labeling.values == first.labelings[0].values; }));
  EXPECT_LE(first.lower_bound, least);
  EXPECT_LE(solve(problem, mode, "all", 1).lower_bound, least);
}

TEST(Backtracking, AsListedByConsistent) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    expect_as_listed(test::random_problem(test::random_kind(seed), seed), mode_of(seed));
    if (testing::Test::HasFailure()) break;
  }
}

TEST(Backtracking, AllModesAgreeInDeeperTrees) {
  const test::RandomKind kind{.variables = 8,
                              .domain = 4,
                              .arity = 3,
                              .constraints = 14,
                              .optional = 0.5,
                              .forbidden_unary = 0.06,
                              .forbidden_entries = 0.3};
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    for (std::uint64_t mode = seed % 7; mode < 540; mode += 7) {
      SCOPED_TRACE(seed);
      expect_as_listed(test::random_problem(kind, seed), mode_of(mode));
      if (testing::Test::HasFailure()) return;
    }
}

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
        EXPECT_EQ(fact(outcome, "consistent labellings"), count);
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
  for (Index w = 0; w < 4; ++w) test::set_conflict(problem, w, w);
  for (const auto& [name, detectability] : {std::pair{"f1", 1.0}, {"f2", 0.75}, {"f3", 0.9}})
    problem.variables.push_back({name, detectability, {0, 1, 2, 3}, {3, 0, 0, 0, 0}});
  const auto relate = [&](const char* name, Index f, Index g, std::vector<std::pair<Index, Index>> pairs) {
    LabelingConstraint constraint = test::empty_constraint(problem, {f, g});
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
    EXPECT_EQ(fact(outcome, "fewest missing"), "0");
  }
}

TEST(Backtracking, ListDoesNotDependOnTheOrderOfTheProblem) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    LabelingProblem reversed = problem;
    std::reverse(reversed.variables.begin(), reversed.variables.end());
    std::reverse(reversed.constraints.begin(), reversed.constraints.end());
    for (LabelingConstraint& constraint : reversed.constraints)
      for (Index& v : constraint.scope) v = static_cast<Index>(problem.variables.size() - 1 - v);
    const Mode mode = mode_of(seed);
    LabelingOutcome one = solve(problem, mode, "count", 1000), other = solve(reversed, mode, "count", 1000);
    EXPECT_EQ(fact(one, "consistent labellings"), fact(other, "consistent labellings"));
    std::vector<std::vector<Index>> ones, others;
    for (const Labeling& labeling : one.labelings) ones.push_back(labeling.values);
    for (Labeling& labeling : other.labelings) {
      std::reverse(labeling.values.begin(), labeling.values.end());
      others.push_back(labeling.values);
    }
    std::sort(ones.begin(), ones.end());
    std::sort(others.begin(), others.end());
    EXPECT_EQ(ones, others);
  }
}

TEST(Backtracking, ThreeQueensCannotAllStand) {
  LabelingProblem problem = test::queens(3);
  LabelingOutcome outcome = test::labeler("backtracking")->solve(problem, {}, test::context());
  EXPECT_TRUE(outcome.labelings.empty());
  EXPECT_TRUE(outcome.optimal);
  EXPECT_EQ(outcome.lower_bound, forbidden);
  EXPECT_EQ(fact(outcome, "consistent labellings"), "0");
  EXPECT_EQ(fact(outcome, "smallest conflicting set"), "'rows 0 and 1', 'rows 0 and 2' and 'rows 1 and 2'");
}

TEST(Backtracking, TellsWhyAFeatureMustBeMissing) {
  LabelingProblem problem = worked_example();
  problem.constraints[0].violations[5 * 1 + 3] = 2;  // f1 = w1, f3 = w3 no longer meet r1
  for (const char* id : {"backtracking", "discrete-relaxation"}) {
    const LabelingOutcome outcome = test::labeler(id)->solve(problem, {}, test::context());
    EXPECT_EQ(fact(outcome, "smallest conflicting set"),
              "'r1', 'r2', 'r3', the exclusion of 'f1' and 'f2' and the exclusion of 'f1' and 'f3'");
    EXPECT_EQ(std::count(outcome.labelings[0].values.begin(), outcome.labelings[0].values.end(), Index{0}), 1);
  }
}

TEST(Backtracking, DomainsOverSixtyFourValues) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(
        {.variables = 3, .domain = 150, .arity = 3, .constraints = 4, .optional = 0.5, .forbidden_entries = 0.7}, seed);
    for (std::uint64_t mode = 0; mode < 18; mode += 5) expect_as_listed(problem, mode_of(mode));
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
