// SPDX-License-Identifier: BSD-3-Clause
// Relaxation labelling: its identities, a step by hand, the theorems of Hummel and Zucker.

#include "toposcope/labeling/relaxation_labeling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/run_context.h"
#include "support/labeling_problems.h"
#include "support/random.h"

namespace {

using namespace toposcope;

constexpr double rounding = 1e-12;

class RelaxationLabeling : public testing::Test {
 protected:
  RunContext context_;
  Deadline deadline_{600, context_};

  std::vector<double> random_weights(const Compatibilities& compatibilities, std::uint64_t seed) {
    test::Random random(seed);
    std::vector<double> weights(compatibilities.labels());
    for (double& weight : weights) weight = random.uniform(0, 1.5);
    project_on_simplexes(compatibilities, weights);
    return weights;
  }

  double consistency(Compatibilities& compatibilities, const std::vector<double>& weights) {
    std::vector<double> support(weights.size());
    return *compatibilities.support(weights, support, deadline_);
  }
};

void expect_on_simplexes(const Compatibilities& compatibilities, const std::vector<double>& weights) {
  for (Index v = 0; v < compatibilities.variables(); ++v) {
    double sum = 0;
    for (std::size_t l = compatibilities.offset(v); l < compatibilities.offset(v + 1); ++l) {
      EXPECT_GE(weights[l], 0);
      sum += weights[l];
    }
    EXPECT_NEAR(sum, 1, rounding);
  }
}

// A(p) by listing every labelling of the allowed values.
double listed_consistency(const LabelingProblem& problem, const CostTables& tables, double saturation, bool lasting,
                          const std::vector<double>& weights) {
  const auto compatibility = [&](double cost) { return std::clamp(-cost / saturation, -1.0, 1.0); };
  std::vector<Index> digits(problem.variables.size(), 0), values(digits.size());
  double sum = 0;
  for (bool more = true; more;) {
    double weight = 1, consistency = 0;
    std::size_t first = 0;
    for (Index v = 0; v < digits.size(); ++v) {
      weight *= weights[first + digits[v]];
      first += tables.allowed(v).size();
      values[v] = static_cast<Index>(tables.allowed(v)[digits[v]] - tables.offset(v));
      const std::vector<double>& costs = problem.variables[v].costs;
      const double least = *std::min_element(costs.begin(), costs.end());
      if (lasting) consistency -= std::min(1.0, (costs[values[v]] - least) / saturation);
      for (Index w = 0; w < v; ++w) consistency -= excluded(problem, v, values[v], w, values[w]);
    }
    for (const LabelingConstraint& constraint : problem.constraints)
      consistency += compatibility(constraint.costs[table_entry(problem, constraint, values)]);
    sum += weight * consistency;
    more = false;
    for (std::size_t v = digits.size(); v-- > 0 && !more;) {
      more = ++digits[v] < tables.allowed(static_cast<Index>(v)).size();
      if (!more) digits[v] = 0;
    }
  }
  return sum;
}

TEST_F(RelaxationLabeling, ConsistencyIsTheExpectedCompatibilityAndSupportItsGradient) {
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const CostTables tables(problem, deadline_);
    if (tables.lower_bound() == forbidden) continue;
    const double saturation = seed % 2 == 0 ? 2.5 : 0;
    const bool lasting = seed % 3 != 0;
    Compatibilities compatibilities(tables, saturation, lasting, deadline_);
    ASSERT_TRUE(compatibilities.complete());
    const std::vector<double> weights = random_weights(compatibilities, seed);
    std::vector<double> support(weights.size()), unused(weights.size());
    const double value = *compatibilities.support(weights, support, deadline_);
    // Compatibilities are kept as floats.
    EXPECT_NEAR(value, listed_consistency(problem, tables, compatibilities.saturation(), lasting, weights), 1e-5)
        << seed;
    for (Index v = 0; v < compatibilities.variables(); ++v) {
      std::vector<double> changed = weights;
      const std::size_t first = compatibilities.offset(v), last = compatibilities.offset(v + 1);
      std::fill(changed.begin() + static_cast<std::ptrdiff_t>(first),
                changed.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
      const double without = *compatibilities.support(changed, unused, deadline_);
      for (std::size_t l = first; l < last; ++l) {
        changed[l] = 1;
        EXPECT_NEAR(support[l], *compatibilities.support(changed, unused, deadline_) - without, 1e-9) << seed;
        changed[l] = 0;
        EXPECT_LE(std::abs(support[l]), static_cast<double>(compatibilities.degree()) + rounding) << seed;
      }
    }
    ++checked;
  }
  EXPECT_GT(checked, 200);
}

TEST_F(RelaxationLabeling, ConsistencyNeverFallsAndWeightsStayOnTheSimplexes) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const CostTables tables(problem, deadline_);
    if (tables.lower_bound() == forbidden) continue;
    Compatibilities compatibilities(tables, 0, true, deadline_);
    for (const bool projected_gradient : {true, false}) {
      std::vector<double> weights = random_weights(compatibilities, seed);
      double before = consistency(compatibilities, weights);
      for (int step = 0; step < 30; ++step) {
        const Relaxed relaxed = relax(compatibilities, weights, {projected_gradient, 1, 0}, deadline_);
        EXPECT_EQ(relaxed.consistency_start, before);
        EXPECT_GE(relaxed.consistency, before - rounding) << seed;
        expect_on_simplexes(compatibilities, relaxed.weights);
        weights = relaxed.weights;
        before = relaxed.consistency;
      }
    }
  }
}

// Hummel and Zucker's definition: no other weights are supported better by the present ones.
TEST_F(RelaxationLabeling, StationaryWeightsAreConsistent) {
  int converged = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const CostTables tables(problem, deadline_);
    if (tables.lower_bound() == forbidden) continue;
    Compatibilities compatibilities(tables, 0, true, deadline_);
    const Relaxed relaxed =
        relax(compatibilities, random_weights(compatibilities, seed), {true, 5000, 1e-9}, deadline_);
    ++all;
    if (relaxed.criterion.find("stationary") == std::string::npos) continue;
    ++converged;
    std::vector<double> support(relaxed.weights.size());
    compatibilities.support(relaxed.weights, support, deadline_);
    for (Index v = 0; v < compatibilities.variables(); ++v) {
      double mean = 0, best = -forbidden;
      for (std::size_t l = compatibilities.offset(v); l < compatibilities.offset(v + 1); ++l) {
        mean += relaxed.weights[l] * support[l];
        best = std::max(best, support[l]);
      }
      EXPECT_LE(best, mean + 1e-7) << seed;
    }
  }
  EXPECT_GT(converged, all * 95 / 100);
}

LabelingProblem two_by_two() {
  LabelingProblem problem;
  problem.variables = {{.name = "a", .costs = {0, 0}, .optional = false},
                       {.name = "b", .costs = {0, 0}, .optional = false}};
  problem.constraints = {{"a-b", {0, 1}, {-1, 0.5, 1, forbidden}}};
  return problem;
}

TEST_F(RelaxationLabeling, RosenfeldHummelZuckerStepByHand) {
  const LabelingProblem problem = two_by_two();
  const CostTables tables(problem, deadline_);
  Compatibilities compatibilities(tables, 1, false, deadline_);
  ASSERT_EQ(compatibilities.degree(), 1U);
  // r = (1, -0.5; -1, -1): q_a = (0.625, -1), q_b = (0, -0.75).
  const Relaxed relaxed = relax(compatibilities, {0.5, 0.5, 0.75, 0.25}, {false, 1, 1e-6}, deadline_);
  EXPECT_NEAR(relaxed.weights[0], 1, rounding);
  EXPECT_NEAR(relaxed.weights[1], 0, rounding);
  EXPECT_NEAR(relaxed.weights[2], 12.0 / 13, rounding);
  EXPECT_NEAR(relaxed.weights[3], 1.0 / 13, rounding);
  EXPECT_NEAR(relaxed.consistency_start, 0.5 * 0.625 - 0.5, rounding);
  EXPECT_NEAR(relaxed.consistency, 12.0 / 13 - 0.5 / 13, rounding);
  EXPECT_EQ(relaxed.criterion, "the limit of iterations");
}

// Hummel and Zucker 1983, section 6: strictly consistent and unambiguous, so a fixed point that attracts.
TEST_F(RelaxationLabeling, StrictlyConsistentLabellingsAttract) {
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const LabelingProblem problem = test::random_problem({5, 4, 3, 8, false, 0.5}, seed);
    const std::vector<Labeling> labelings = test::all_labelings(problem);
    const CostTables tables(problem, deadline_);
    if (labelings.empty()) continue;
    Compatibilities compatibilities(tables, 0, true, deadline_);
    std::vector<double> vertex(compatibilities.labels(), 0), support(vertex.size());
    std::vector<std::size_t> chosen;
    for (Index v = 0; v < compatibilities.variables(); ++v) {
      const auto allowed = tables.allowed(v);
      const auto at = std::find(allowed.begin(), allowed.end(), tables.offset(v) + labelings[0].values[v]);
      chosen.push_back(compatibilities.offset(v) + static_cast<std::size_t>(at - allowed.begin()));
      vertex[chosen.back()] = 1;
    }
    compatibilities.support(vertex, support, deadline_);
    double margin = forbidden;
    for (Index v = 0; v < compatibilities.variables(); ++v)
      for (std::size_t l = compatibilities.offset(v); l < compatibilities.offset(v + 1); ++l)
        if (l != chosen[v]) margin = std::min(margin, support[chosen[v]] - support[l]);
    if (margin < 0.05) continue;
    ++checked;
    for (const bool projected_gradient : {true, false}) {
      const RelaxationRules rules{projected_gradient, 20000, 1e-12};
      const Relaxed fixed = relax(compatibilities, vertex, rules, deadline_);
      for (std::size_t l = 0; l < vertex.size(); ++l) EXPECT_EQ(fixed.weights[l], vertex[l]);
      std::vector<double> near = random_weights(compatibilities, seed);
      for (std::size_t l = 0; l < vertex.size(); ++l) near[l] = 0.998 * vertex[l] + 0.002 * near[l];
      const Relaxed back = relax(compatibilities, near, rules, deadline_);
      EXPECT_TRUE(back.converged);
      for (std::size_t l = 0; l < vertex.size(); ++l) EXPECT_NEAR(back.weights[l], vertex[l], 1e-6) << seed;
    }
  }
  EXPECT_GT(checked, 20);
}

TEST_F(RelaxationLabeling, SymmetricStaysSymmetric) {
  // Three alike variables on a ring, two labels of equal cost; alike ones attract, rows and columns equal.
  LabelingProblem problem;
  for (const char* name : {"a", "b", "c"})
    problem.variables.push_back({.name = name, .costs = {1, 1}, .optional = false});
  for (Index v = 0; v < 3; ++v) problem.constraints.push_back({"alike", {v, (v + 1) % 3}, {-1, 1, 1, -1}});
  const CostTables tables(problem, deadline_);
  Compatibilities compatibilities(tables, 0, true, deadline_);
  for (const bool projected_gradient : {true, false}) {
    const RelaxationRules rules{projected_gradient, 100, 1e-6};
    const Relaxed uniform = relax(compatibilities, std::vector<double>(6, 0.5), rules, deadline_);
    for (const double weight : uniform.weights) EXPECT_EQ(weight, 0.5);  // a saddle, by symmetry
    EXPECT_NEAR(mean_entropy(compatibilities, uniform.weights), std::log(2), rounding);
    const Relaxed tilted =
        relax(compatibilities, {0.6, 0.4, 0.6, 0.4, 0.6, 0.4}, {projected_gradient, 3, 0}, deadline_);
    for (std::size_t l = 2; l < 6; ++l) EXPECT_NEAR(tilted.weights[l], tilted.weights[l - 2], rounding);
    EXPECT_GT(tilted.weights[0], 0.6);
  }
}

TEST_F(RelaxationLabeling, ProjectionIsTheNearestPoint) {
  LabelingProblem problem;
  problem.variables = {{.name = "a", .costs = std::vector<double>(7, 0), .optional = false}};
  const CostTables tables(problem, deadline_);
  const Compatibilities compatibilities(tables, 0, true, deadline_);
  test::Random random(1);
  const auto squares = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t l = 0; l < a.size(); ++l) sum += (a[l] - b[l]) * (a[l] - b[l]);
    return sum;
  };
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> y(7), p;
    const double scale = std::pow(10, random.uniform(-3, 4));
    for (double& x : y) x = trial % 3 == 0 ? scale * std::round(random.uniform(-2, 2)) : scale * random.uniform(-1, 1);
    p = y;
    project_on_simplexes(compatibilities, p);
    expect_on_simplexes(compatibilities, p);
    // (y - p)(v - p) <= 0 for every vertex v.
    for (std::size_t vertex = 0; vertex < 7; ++vertex) {
      double product = 0;
      for (std::size_t l = 0; l < 7; ++l) product += (y[l] - p[l]) * ((l == vertex ? 1 : 0) - p[l]);
      EXPECT_LE(product, 1e-9 * (1 + scale));
    }
    std::vector<double> again = p;
    project_on_simplexes(compatibilities, again);
    EXPECT_NEAR(squares(again, p), 0, rounding);
  }
}

TEST_F(RelaxationLabeling, StoppedSaysSo) {
  const LabelingProblem problem = two_by_two();
  const CostTables tables(problem, deadline_);
  Compatibilities compatibilities(tables, 0, true, deadline_);
  context_.cancel();
  const Relaxed relaxed = relax(compatibilities, {0.5, 0.5, 0.5, 0.5}, {}, deadline_);
  EXPECT_FALSE(relaxed.converged);
  EXPECT_EQ(relaxed.iterations, 0);
  EXPECT_EQ(relaxed.weights, (std::vector<double>{0.5, 0.5, 0.5, 0.5}));
  EXPECT_FALSE(Compatibilities(tables, 0, true, deadline_).complete());
}

}  // namespace
