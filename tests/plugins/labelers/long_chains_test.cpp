// SPDX-License-Identifier: BSD-3-Clause
// Chains of thousands of variables: their optimum and evidence by dynamic programming.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

LabelingProblem chain(Index length, Index domain) {
  std::mt19937_64 random(7);
  const auto cost = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 * 4; };
  LabelingProblem problem;
  for (Index v = 0; v < length; ++v) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "x" + std::to_string(v);
    variable.optional = false;
    for (Index value = 0; value < domain; ++value) variable.costs.push_back(cost());
  }
  for (Index v = 0; v + 1 < length; ++v) {
    LabelingConstraint constraint = empty_constraint(problem, {v, v + 1});
    constraint.violations.clear();
    for (double& entry : constraint.costs) entry = cost();
    problem.constraints.push_back(std::move(constraint));
  }
  return problem;
}

/// Along the chain: `join` of what a value and each before it cost.
template <class Join>
double along(const LabelingProblem& problem, const Join& join) {
  std::vector<double> costs = problem.variables[0].costs;
  for (Index v = 1; v < problem.variables.size(); ++v) {
    const Index width = problem.variables[v].domain();
    std::vector<double> next(width), ways(costs.size());
    for (Index b = 0; b < width; ++b) {
      for (Index a = 0; a < costs.size(); ++a) ways[a] = costs[a] + problem.constraints[v - 1].costs[a * width + b];
      next[b] = problem.variables[v].costs[b] + join(ways);
    }
    costs = std::move(next);
  }
  return join(costs);
}

double least(const std::vector<double>& costs) {
  return *std::min_element(costs.begin(), costs.end());
}

double soft_least(const std::vector<double>& costs) {
  double sum = 0;
  for (const double cost : costs) sum += std::exp(least(costs) - cost);
  return least(costs) - std::log(sum);
}

TEST(LongChains, OptimumAndEvidenceOfDynamicProgramming) {
  for (const auto& [length, domain] : {std::pair<Index, Index>{2000, 5}, {5000, 20}, {60000, 2}}) {
    const LabelingProblem problem = chain(length, domain);
    const double optimum = along(problem, least), evidence = -along(problem, soft_least);
    for (const char* id : {"least-error", "posterior"}) {
      SCOPED_TRACE(std::string(id) + " " + std::to_string(length));
      const LabelingOutcome outcome =
          test::labeler(id)->solve(problem, {.k_best = 10, .time_limit_s = 60}, test::context());
      EXPECT_TRUE(outcome.optimal) << outcome.guarantee;
      ASSERT_EQ(outcome.labelings.size(), 10U);
      EXPECT_NEAR(outcome.labelings[0].cost, optimum, 1e-9 * optimum);
      EXPECT_EQ(cost_of(problem, outcome.labelings[0].values), outcome.labelings[0].cost);
      EXPECT_EQ(outcome.lower_bound, outcome.labelings[0].cost);
      EXPECT_EQ(outcome.nodes, length);  // one visit each: no search
      if (std::string(id) == "posterior") {
        EXPECT_EQ(outcome.evidence_exactness, Exactness::exact);
        EXPECT_NEAR(outcome.log_evidence, evidence, 1e-9 * std::abs(evidence) + 1e-6);
      }
    }
  }
}

}  // namespace
