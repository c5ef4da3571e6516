// SPDX-License-Identifier: BSD-3-Clause
// Discrete relaxation against a naive fixpoint and against listing by `consistent`.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "support/labeler_checks.h"
#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

using Domains = std::vector<std::vector<bool>>;

Index missing_in(const LabelingProblem& problem, const std::vector<Index>& values) {
  Index missing = 0;
  for (Index v = 0; v < values.size(); ++v) missing += problem.variables[v].missing(values[v]);
  return missing;
}

bool allows(const LabelingConstraint& constraint, std::size_t entry) {
  return constraint.costs[entry] < forbidden && satisfied(constraint, entry);
}

Domains open_domains(const LabelingProblem& problem, bool with_missing) {
  Domains domains;
  for (const LabelingVariable& variable : problem.variables) {
    domains.emplace_back(variable.domain(), true);
    if (variable.optional && !with_missing) domains.back()[0] = false;
  }
  return domains;
}

// Whether, over the values that stand in the domains, something denies the value every support: its own cost, a
// constraint over more than two variables, or all that binds it to one other variable.
bool unsupported(const LabelingProblem& problem, const Domains& domains, Index variable, Index value) {
  if (!(problem.variables[variable].costs[value] < forbidden)) return true;
  for (const LabelingConstraint& constraint : problem.constraints) {
    if (std::count(constraint.scope.begin(), constraint.scope.end(), variable) == 0 || constraint.scope.size() == 2)
      continue;
    bool found = false;
    std::vector<Index> digits(constraint.scope.size(), 0);
    std::size_t entry = 0;
    do {
      bool valid = allows(constraint, entry++);
      for (std::size_t k = 0; k < digits.size() && valid; ++k)
        valid = constraint.scope[k] == variable ? digits[k] == value : domains[constraint.scope[k]][digits[k]];
      found = found || valid;
    } while (next_entry(problem, constraint, digits));
    if (!found) return true;
  }
  for (Index other = 0; other < problem.variables.size(); ++other) {
    if (other == variable) continue;
    bool found = false;
    for (Index w = 0; w < problem.variables[other].domain() && !found; ++w) {
      found = domains[other][w] && !excluded(problem, variable, value, other, w);
      for (const LabelingConstraint& constraint : problem.constraints) {
        if (constraint.scope == std::vector<Index>{variable, other})
          found = found && allows(constraint, value * problem.variables[other].domain() + w);
        if (constraint.scope == std::vector<Index>{other, variable})
          found = found && allows(constraint, w * problem.variables[variable].domain() + value);
      }
    }
    if (!found) return true;
  }
  return false;
}

bool emptied(const Domains& domains) {
  return std::any_of(domains.begin(), domains.end(), [](const std::vector<bool>& domain) {
    return std::find(domain.begin(), domain.end(), true) == domain.end();
  });
}

Domains naive_fixpoint(const LabelingProblem& problem, Domains domains) {
  for (bool changed = true; changed;) {
    changed = false;
    for (Index v = 0; v < domains.size(); ++v)
      for (Index value = 0; value < domains[v].size(); ++value)
        if (domains[v][value] && unsupported(problem, domains, v, value)) {
          domains[v][value] = false;
          changed = true;
        }
  }
  return domains;
}

LabelingOutcome relax(const LabelingProblem& problem, const char* missing, bool search) {
  return test::labeler("discrete-relaxation", {{"missing", missing}, {"search", search ? "true" : "false"}})
      ->solve(problem, {10, 60}, test::context());
}

Domains left_by(const LabelingProblem& problem, const LabelingOutcome& outcome, bool with_missing) {
  Domains domains = open_domains(problem, with_missing);
  for (const RemovedValue& removed : outcome.removed) domains[removed.variable][removed.value] = false;
  return domains;
}

TEST(DiscreteRelaxation, ReachesTheFixpointAndEveryValueFellForAReason) {
  int wiped_out = 0, struck = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    for (const bool with_missing : {true, false}) {
      const LabelingOutcome outcome = relax(problem, with_missing ? "allowed" : "never", false);
      const Domains fixpoint = naive_fixpoint(problem, open_domains(problem, with_missing));
      EXPECT_EQ(test::fact(outcome, "emptied domain").empty(), !emptied(fixpoint));
      if (emptied(fixpoint))
        ++wiped_out;
      else
        ASSERT_EQ(left_by(problem, outcome, with_missing), fixpoint);
      // Each value was without support when it fell, and fell once.
      Domains domains = open_domains(problem, with_missing);
      for (const RemovedValue& removed : outcome.removed) {
        if (problem.variables[removed.variable].missing(removed.value) && !with_missing) continue;
        EXPECT_TRUE(domains[removed.variable][removed.value]);
        EXPECT_TRUE(unsupported(problem, domains, removed.variable, removed.value));
        EXPECT_FALSE(removed.reason.empty());
        domains[removed.variable][removed.value] = false;
        ++struck;
      }
    }
  }
  EXPECT_GT(wiped_out, 100);
  EXPECT_GT(struck, 1000);
}

TEST(DiscreteRelaxation, NoValueOfASolutionFalls) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    for (const bool with_missing : {true, false}) {
      const LabelingOutcome outcome = relax(problem, with_missing ? "allowed" : "never", false);
      const Domains left = left_by(problem, outcome, with_missing);
      for (const Labeling& labeling : test::all_labelings(problem)) {
        if (!consistent(problem, labeling.values) || (!with_missing && missing_in(problem, labeling.values) > 0))
          continue;
        for (Index v = 0; v < left.size(); ++v) ASSERT_TRUE(left[v][labeling.values[v]]);
        EXPECT_EQ(test::fact(outcome, "emptied domain"), "");
      }
    }
  }
}

TEST(DiscreteRelaxation, LabelsWhereAConsistentLabellingExists) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    std::vector<Index> missing;  // in each consistent labelling
    for (const Labeling& labeling : test::all_labelings(problem))
      if (consistent(problem, labeling.values)) missing.push_back(missing_in(problem, labeling.values));
    std::sort(missing.begin(), missing.end());
    for (const std::string mode : {"allowed", "never", "only-if-needed"}) {
      const LabelingOutcome outcome = relax(problem, mode.c_str(), true);
      const bool exists = mode == "never" ? !missing.empty() && missing[0] == 0 : !missing.empty();
      if (!exists) {
        EXPECT_EQ(outcome.labelings.size(), all_missing(problem).size());
        EXPECT_EQ(outcome.optimal, outcome.labelings.empty());
        const std::vector<Labeling> finite = test::all_labelings(problem);
        EXPECT_LE(outcome.lower_bound, finite.empty() ? forbidden : finite[0].cost);
        continue;
      }
      ASSERT_EQ(outcome.labelings.size(), 1U);
      EXPECT_TRUE(consistent(problem, outcome.labelings[0].values));
      EXPECT_EQ(outcome.labelings[0].cost, cost_of(problem, outcome.labelings[0].values));
      EXPECT_LE(outcome.lower_bound, test::all_labelings(problem)[0].cost);
      if (mode != "allowed") {
        EXPECT_EQ(missing_in(problem, outcome.labelings[0].values), missing[0]);
      }
      if (!outcome.optimal) continue;
      const auto complete = std::count(missing.begin(), missing.end(), Index{0});
      EXPECT_EQ(mode == "allowed" ? std::ssize(missing) : complete, 1);  // the only one
    }
  }
}

TEST(DiscreteRelaxation, FixpointDoesNotDependOnAnyOrder) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    LabelingProblem reversed = problem;
    std::reverse(reversed.variables.begin(), reversed.variables.end());
    std::reverse(reversed.constraints.begin(), reversed.constraints.end());
    for (LabelingConstraint& constraint : reversed.constraints)
      for (Index& v : constraint.scope) v = static_cast<Index>(problem.variables.size() - 1 - v);
    const LabelingOutcome one = relax(problem, "never", false), other = relax(reversed, "never", false);
    ASSERT_EQ(test::fact(one, "emptied domain").empty(), test::fact(other, "emptied domain").empty());
    if (!test::fact(one, "emptied domain").empty()) continue;
    Domains turned = left_by(reversed, other, false);
    std::reverse(turned.begin(), turned.end());
    EXPECT_EQ(left_by(problem, one, false), turned);
  }
}

// Four queens: no corner stands (the others leave one square of the row beside it and none two rows on); arc
// consistency alone strikes nothing. With the first in column 0 it strikes until a row is empty.
TEST(DiscreteRelaxation, FourQueens) {
  LabelingProblem problem = test::queens(4);
  LabelingOutcome outcome = relax(problem, "allowed", false);
  EXPECT_TRUE(outcome.removed.empty());
  EXPECT_TRUE(outcome.labelings.empty());
  EXPECT_FALSE(outcome.optimal);
  EXPECT_EQ(test::fact(outcome, "domain of 'row0'"), "4 of 4: 0, 1, 2, 3");
  problem.variables[0].costs = {0, forbidden, forbidden, forbidden};
  outcome = relax(problem, "allowed", true);
  EXPECT_TRUE(outcome.labelings.empty());
  EXPECT_TRUE(outcome.optimal);
  EXPECT_NE(test::fact(outcome, "emptied domain"), "");
  EXPECT_EQ(outcome.nodes, 0U);
  EXPECT_EQ(outcome.removed[0].reason, "its cost is infinite");
  problem.variables[0].costs = {forbidden, 0, forbidden, forbidden};
  outcome = relax(problem, "allowed", false);
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_EQ(outcome.labelings[0].values, (std::vector<Index>{1, 3, 0, 2}));
  EXPECT_TRUE(outcome.optimal);
  EXPECT_EQ(outcome.removed[3].reason, "no value left of 'row0' meets 'rows 0 and 1' with it");
}

TEST(DiscreteRelaxation, TellsTheExclusionAndWhatActsTogether) {
  LabelingProblem problem;
  problem.candidate_count = 2;
  for (Index c = 0; c < 2; ++c) set_conflict(problem, c, c);
  problem.variables = {{"rim", 1, {0}, {0, 0}}, {"edge", 1, {0, 1}, {0, 0, 0}}};
  LabelingOutcome outcome = relax(problem, "never", false);
  ASSERT_EQ(outcome.removed.size(), 1U);
  EXPECT_EQ(outcome.removed[0].variable, 1U);
  EXPECT_EQ(outcome.removed[0].value, 1U);
  EXPECT_EQ(outcome.removed[0].reason, "no value of 'rim' can stand beside it: all share a vertex with it");
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_EQ(outcome.labelings[0].values, (std::vector<Index>{1, 2}));

  LabelingConstraint r1 = empty_constraint(problem, {0, 1});
  r1.name = "r1";
  r1.violations[1 * 3 + 2] = 2;
  problem.constraints.push_back(r1);
  outcome = relax(problem, "never", false);
  EXPECT_EQ(test::fact(outcome, "emptied domain"), "edge");
  ASSERT_FALSE(outcome.removed.empty());
  EXPECT_EQ(outcome.removed.back().reason, "no value of 'rim' meets 'r1' with it");
  problem.variables[0] = {"rim", 1, {0, 1}, {0, 0, 0}};
  problem.constraints = {empty_constraint(problem, {0, 1})};
  problem.constraints[0].name = "r1";
  problem.constraints[0].violations[1 * 3 + 2] = 2;
  problem.constraints[0].violations[2 * 3 + 1] = 2;
  outcome = relax(problem, "never", false);
  EXPECT_EQ(outcome.removed[0].reason, "no value of 'rim' meets 'r1' and the exclusion with it");
}

TEST(DiscreteRelaxation, StoppedAndCancelled) {
  const LabelingProblem problem =
      test::random_problem({.variables = 40, .domain = 60, .arity = 2, .constraints = 400}, 7);
  RunContext cancelled;
  cancelled.cancel();
  const LabelingOutcome outcome = test::labeler("discrete-relaxation")->solve(problem, {}, cancelled);
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_FALSE(outcome.optimal);
  for (const double limit_s : {0.0, 1e-3, 0.01}) {
    const LabelingOutcome cut = test::labeler("discrete-relaxation")->solve(problem, {10, limit_s}, test::context());
    ASSERT_EQ(cut.labelings.size(), 1U);
    EXPECT_TRUE(meets_exclusions(problem, cut.labelings[0].values));
  }
}

TEST(DiscreteRelaxation, ProblemWithoutVariables) {
  EXPECT_EQ(relax({}, "allowed", true).labelings.size(), 1U);
}

}  // namespace
