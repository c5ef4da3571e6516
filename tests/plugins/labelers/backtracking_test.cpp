// SPDX-License-Identifier: BSD-3-Clause
// Backtracking against listing by `consistent`.

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "support/labeler_checks.h"
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
      ASSERT_EQ(test::fact(outcome, "consistent labellings"), std::to_string(all.size()));
    }
    if (all.empty()) {
      EXPECT_EQ(outcome.labelings.size(), all_missing(problem).size());
      EXPECT_EQ(outcome.optimal, outcome.labelings.empty());
      EXPECT_LE(outcome.lower_bound, least);
      continue;
    }
    EXPECT_TRUE(outcome.optimal);
    if (missing == "only-if-needed") {
      EXPECT_EQ(test::fact(outcome, "fewest missing"), std::to_string(fewest));
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
    EXPECT_EQ(test::fact(one, "consistent labellings"), test::fact(other, "consistent labellings"));
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

TEST(Backtracking, DomainsOverSixtyFourValues) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(
        {.variables = 3, .domain = 150, .arity = 3, .constraints = 4, .optional = 0.5, .forbidden_entries = 0.7}, seed);
    for (std::uint64_t mode = 0; mode < 18; mode += 5) expect_as_listed(problem, mode_of(mode));
  }
}

}  // namespace
