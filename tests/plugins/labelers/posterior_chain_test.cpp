// SPDX-License-Identifier: BSD-3-Clause
// Marginals and evidence of chains against transfer matrices, also where costs are large.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "posterior_fixture.h"
#include "support/labeler_checks.h"
#include "support/labeling_problems.h"

namespace {

using namespace toposcope;

LabelingProblem chain(Index length, double scale) {
  LabelingProblem problem;
  for (Index v = 0; v < length; ++v) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "x" + std::to_string(v);
    variable.optional = false;
    variable.costs = {scale * std::sin(v + 1.0), scale * std::cos(3.0 * v)};
  }
  for (Index v = 0; v + 1 < length; ++v) {
    LabelingConstraint constraint = empty_constraint(problem, {v, v + 1});
    constraint.violations.clear();
    for (Index e = 0; e < 4; ++e) constraint.costs[e] = scale * std::sin(5.0 * v + 2.0 * e);
    problem.constraints.push_back(std::move(constraint));
  }
  return problem;
}

// exp(-cost) multiplied along the chain from both ends, scaled at each step: what is known of transfer matrices.
TEST(Posterior, ChainIsTransferMatrices) {
  const Index n = 120;
  const LabelingProblem problem = chain(n, 1);
  const auto weight = [](double cost) { return std::exp(-cost); };
  std::vector<std::array<double, 2>> left(n), right(n);
  double log_evidence = 0;
  for (Index v = 0; v < n; ++v) {
    for (Index b = 0; b < 2; ++b) {
      double sum = v == 0 ? 1 : 0;
      if (v > 0)
        for (Index a = 0; a < 2; ++a) sum += left[v - 1][a] * weight(problem.constraints[v - 1].costs[2 * a + b]);
      left[v][b] = sum * weight(problem.variables[v].costs[b]);
    }
    const double scale = left[v][0] + left[v][1];
    log_evidence += std::log(scale);
    for (double& x : left[v]) x /= scale;
  }
  right[n - 1] = {1, 1};
  for (Index v = n - 1; v-- > 0;) {
    for (Index a = 0; a < 2; ++a) {
      right[v][a] = 0;
      for (Index b = 0; b < 2; ++b)
        right[v][a] +=
            weight(problem.constraints[v].costs[2 * a + b] + problem.variables[v + 1].costs[b]) * right[v + 1][b];
    }
    const double scale = right[v][0] + right[v][1];
    for (double& x : right[v]) x /= scale;
  }
  for (const char* method : {"auto", "elimination", "belief-propagation"}) {
    const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", method}});
    EXPECT_EQ(outcome.guarantee.substr(0, 5), "exact") << outcome.guarantee;
    EXPECT_NEAR(outcome.log_evidence, log_evidence, 1e-9) << method;
    for (Index v = 0; v < n; ++v) {
      const double sum = left[v][0] * right[v][0] + left[v][1] * right[v][1];
      for (Index b = 0; b < 2; ++b)
        EXPECT_NEAR(outcome.posteriors[v][b], left[v][b] * right[v][b] / sum, 1e-9) << method << " " << v;
    }
  }
  // The best labelling of a chain is Viterbi's.
  std::array<double, 2> best = {problem.variables[0].costs[0], problem.variables[0].costs[1]};
  for (Index v = 1; v < n; ++v) {
    const auto step = [&](Index b) {
      return problem.variables[v].costs[b] +
             std::min(best[0] + problem.constraints[v - 1].costs[b], best[1] + problem.constraints[v - 1].costs[2 + b]);
    };
    best = {step(0), step(1)};
  }
  const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", "elimination"}});
  EXPECT_TRUE(outcome.optimal);
  EXPECT_NEAR(outcome.labelings.front().cost, std::min(best[0], best[1]), 1e-9);
  EXPECT_EQ(outcome.labelings.size(), 10);
}

TEST(Posterior, CostsOfTenThousandNatsDoNotUnderflow) {
  const LabelingProblem problem = chain(12, 1e4);
  const auto all = test::all_labelings(problem);
  const auto sums = test::sums(problem, all);
  EXPECT_LT(all.front().cost, -1e4);
  EXPECT_GT(all.back().cost, 1e4);
  for (const char* method : {"auto", "elimination", "search", "belief-propagation"}) {
    const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", method}});
    EXPECT_NEAR(outcome.log_evidence, sums.log_evidence, 1e-7) << method;
    test::expect_posteriors(outcome, sums.posteriors, 1e-7);
    EXPECT_EQ(outcome.labelings.front().values, all.front().values) << method;
  }
}

}  // namespace
