// SPDX-License-Identifier: BSD-3-Clause
#include "support/labeler_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "toposcope/labeling/tools.h"

namespace toposcope::test {
namespace {

/// The sums of bound and cost may be made in another order.
double rounding(double cost) {
  return 1e-9 * (1 + std::abs(cost));
}

}  // namespace

std::string fact(const LabelingOutcome& outcome, std::string_view name) {
  for (const LabelingFact& fact : outcome.facts)
    if (fact.name == name) return fact.value;
  return "";
}

void expect_sound(const LabelingProblem& problem, const LabelingOutcome& outcome) {
  std::set<std::vector<Index>> seen;
  for (const Labeling& labeling : outcome.labelings) {
    ASSERT_EQ(labeling.values.size(), problem.variables.size());
    for (Index v = 0; v < labeling.values.size(); ++v) ASSERT_LT(labeling.values[v], problem.variables[v].domain());
    EXPECT_TRUE(seen.insert(labeling.values).second) << "listed twice";
    EXPECT_TRUE(meets_exclusions(problem, labeling.values));
    EXPECT_EQ(labeling.cost, cost_of(problem, labeling.values));
    EXPECT_LE(outcome.lower_bound, labeling.cost + rounding(labeling.cost));
  }
  EXPECT_FALSE(outcome.guarantee.empty());
}

void expect_sound(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::vector<Labeling>& all) {
  expect_sound(problem, outcome);
  if (!all.empty()) {
    EXPECT_LE(outcome.lower_bound, all[0].cost + rounding(all[0].cost));
  }
  const bool may_be_empty = std::any_of(problem.variables.begin(), problem.variables.end(),
                                        [](const LabelingVariable& variable) { return !variable.optional; });
  EXPECT_TRUE(may_be_empty || !outcome.labelings.empty());
}

bool expect_honest(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::vector<Labeling>& all) {
  expect_sound(problem, outcome, all);
  if (all.empty() || outcome.labelings.empty()) return false;
  EXPECT_LE(outcome.lower_bound, all[0].cost);
  EXPECT_LT(outcome.labelings[0].cost, forbidden);
  EXPECT_GE(outcome.labelings[0].cost, all[0].cost);
  const bool found = outcome.labelings[0].cost == all[0].cost;
  EXPECT_TRUE(found || !outcome.optimal);
  EXPECT_TRUE(std::is_sorted(outcome.labelings.begin(), outcome.labelings.end(),
                             [](const Labeling& a, const Labeling& b) { return a.cost < b.cost; }));
  return found;
}

void expect_posteriors(const LabelingOutcome& outcome, const std::vector<std::vector<double>>& expected,
                       double tolerance) {
  ASSERT_EQ(outcome.posteriors.size(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v) {
    ASSERT_EQ(outcome.posteriors[v].size(), expected[v].size());
    for (std::size_t value = 0; value < expected[v].size(); ++value)
      EXPECT_NEAR(outcome.posteriors[v][value], expected[v][value], tolerance) << v << " " << value;
  }
}

}  // namespace toposcope::test
