// SPDX-License-Identifier: BSD-3-Clause
// Belief propagation against brute force: exact on forests, near it elsewhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "posterior_fixture.h"
#include "support/labeler_checks.h"
#include "support/labeling_problems.h"
#include "toposcope/labeling/tools.h"
#include "toposcope/system/random.h"

namespace {

using namespace toposcope;

/// A forest: variable i > 0 hangs on a variable before it, now and then on none, or two hang on one by a ternary table.
LabelingProblem random_forest(std::uint64_t seed) {
  test::RandomKind kind;
  kind.variables = 2 + static_cast<int>(seed % 5);
  kind.constraints = 0;
  LabelingProblem problem = test::random_problem(kind, seed);
  for (LabelingVariable& variable : problem.variables) variable.candidates.clear();
  LinearCongruential draw(seed);
  for (Index v = 1; v < problem.variables.size(); ++v) {
    if (draw.below(5) == 0) continue;
    std::vector<Index> scope{static_cast<Index>(draw.below(v)), v};
    if (v + 1 < problem.variables.size() && draw.below(3) == 0) scope.insert(scope.begin(), ++v);
    LabelingConstraint constraint = empty_constraint(problem, scope);
    for (double& cost : constraint.costs)
      cost = draw.below(8) == 0 ? forbidden : static_cast<double>(draw.below(1000)) / 100 - 5;
    problem.constraints.push_back(std::move(constraint));
  }
  return problem;
}

TEST(Posterior, BeliefPropagationIsExactOnForests) {
  int propagated = 0;
  for (std::uint64_t seed = 0; seed < 500 && !HasFailure(); ++seed) {
    const LabelingProblem problem = random_forest(seed);
    const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", "belief-propagation"}});
    SCOPED_TRACE(seed);
    EXPECT_EQ(outcome.guarantee.substr(0, 5), "exact") << outcome.guarantee;
    const auto all = test::all_labelings(problem);
    const auto sums = test::sums(problem, all);
    if (all.empty()) {
      EXPECT_EQ(outcome.log_evidence, -forbidden);
      continue;
    }
    ++propagated;
    EXPECT_EQ(test::fact(outcome, "converged"), "yes");
    EXPECT_EQ(outcome.evidence_exactness, Exactness::exact);
    EXPECT_NEAR(outcome.log_evidence, sums.log_evidence, 1e-9);
    test::expect_posteriors(outcome, sums.posteriors, 1e-9);
    ASSERT_FALSE(outcome.labelings.empty());
    EXPECT_LE(outcome.lower_bound, all.front().cost);
  }
  EXPECT_GT(propagated, 400);
}

TEST(Posterior, LoopyBeliefPropagationSaysSoAndIsNear) {
  double worst = 0, mean = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 1000 && !HasFailure(); ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const auto all = test::all_labelings(problem);
    const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", "belief-propagation"}});
    if (all.empty() || outcome.guarantee.substr(0, 5) == "exact") continue;
    EXPECT_EQ(outcome.guarantee.substr(0, 11), "approximate") << outcome.guarantee;
    EXPECT_EQ(outcome.posterior_exactness, Exactness::approximate);
    EXPECT_EQ(outcome.evidence_exactness, Exactness::approximate);
    EXPECT_NE(test::fact(outcome, "sweeps"), "");
    EXPECT_NE(test::fact(outcome, "residual"), "");
    EXPECT_FALSE(outcome.optimal);
    test::expect_sound(problem, outcome, all);
    const auto sums = test::sums(problem, all);
    for (std::size_t v = 0; v < sums.posteriors.size(); ++v) {
      double total = 0;
      for (std::size_t value = 0; value < sums.posteriors[v].size(); ++value) {
        total += outcome.posteriors[v][value];
        const double error = std::abs(outcome.posteriors[v][value] - sums.posteriors[v][value]);
        worst = std::max(worst, error);
        mean += error;
        ++count;
      }
      EXPECT_NEAR(total, 1, 1e-12);
    }
  }
  ASSERT_GT(count, 1000);
  EXPECT_LT(mean / count, 0.02);
  EXPECT_GT(worst, 1e-6);  // else it would be the exact method
}

}  // namespace
