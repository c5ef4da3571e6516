// SPDX-License-Identifier: BSD-3-Clause
// Elimination against brute force on trees, cycles and whatever else, and its orders on graphs of known width.

#include "toposcope/labeling/elimination.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/labeling_problems.h"

namespace {

using namespace toposcope;

struct NoLimits final : Context {
  void log(LogLevel, std::string_view) override {}
  void progress(double) override {}
  bool cancelled() const override { return false; }
  std::uint64_t seed() const override { return 1; }
  unsigned threads() const override { return 1; }
  void parallel_for(std::size_t count, std::size_t,
                    const std::function<void(std::size_t, std::size_t)>& body) override {
    body(0, count);
  }
  std::uint64_t memory_budget() const override { return std::uint64_t{1} << 30; }
};

struct Eliminated {
  BestLabelings best;
  double log_evidence = -forbidden;
  std::vector<std::vector<double>> marginals;  ///< per variable, per value of the problem
  factors::EliminationPlan plan;
};

Eliminated eliminate(const LabelingProblem& problem, std::size_t k) {
  NoLimits context;
  Deadline deadline(forbidden, context);
  factors::Watch watch(deadline);
  Eliminated made{BestLabelings(k, forbidden), -forbidden, {}, {}};
  const factors::FactorGraph graph = factors::factor_graph(problem, watch);
  if (graph.impossible) return made;
  made.plan = factors::elimination_plan(graph, 1e8, watch);
  factors::Elimination elimination(graph, made.plan, watch);
  const double least = elimination.minimize();
  if (!(least < forbidden)) return made;
  const factors::Offer offer = [&](const std::vector<Index>& at) {
    Labeling labeling{std::vector<Index>(at.size()), 0};
    for (Index v = 0; v < at.size(); ++v) labeling.values[v] = graph.values[v][at[v]];
    labeling.cost = cost_of(problem, labeling.values);
    made.best.offer(labeling);
  };
  elimination.k_best(least, {.k = k, .slack = rounding_slack(problem), .offer = offer, .list = made.best});
  made.log_evidence = -elimination.sum();
  const auto marginals = elimination.marginals();
  for (Index v = 0; v < graph.variables(); ++v) {
    made.marginals.emplace_back(problem.variables[v].domain(), 0.0);
    for (std::size_t i = 0; i < marginals[v].size(); ++i) made.marginals[v][graph.values[v][i]] = marginals[v][i];
  }
  return made;
}

void expect_as_by_brute_force(const LabelingProblem& problem, std::uint64_t seed) {
  SCOPED_TRACE(seed);
  const std::vector<Labeling> all = test::all_labelings(problem);
  const test::BruteForce sums = test::sums(problem, all);
  for (const std::size_t k : {std::size_t{1}, std::size_t{6}, all.size() + 2}) {
    const Eliminated made = eliminate(problem, k);
    const std::vector<Labeling>& best = made.best.labelings();
    ASSERT_EQ(best.size(), std::min(k, all.size()));
    if (all.empty()) continue;
    EXPECT_EQ(best[0].values, all[0].values);
    for (std::size_t i = 0; i < best.size(); ++i) EXPECT_EQ(best[i].cost, all[i].cost) << i << " of " << k;
    EXPECT_NEAR(made.log_evidence, sums.log_evidence, 1e-9);
    for (Index v = 0; v < problem.variables.size(); ++v)
      for (Index value = 0; value < problem.variables[v].domain(); ++value)
        EXPECT_NEAR(made.marginals[v][value], sums.posteriors[v][value], 1e-9);
  }
}

/// Variables that may not be missing, and tables over pairs of them; costs in eighths: ties.
/// \param hard  some entries are forbidden
LabelingProblem problem_on(const std::vector<Index>& domains, const std::vector<std::pair<Index, Index>>& links,
                           std::uint64_t seed, bool hard) {
  std::mt19937_64 random(seed);
  const auto cost = [&] { return static_cast<double>(random() % 32) / 8 - 1; };
  LabelingProblem problem;
  for (const Index domain : domains) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "x" + std::to_string(problem.variables.size());
    variable.optional = false;
    for (Index value = 0; value < domain; ++value) variable.costs.push_back(cost());
  }
  for (const auto& [v, w] : links) {
    LabelingConstraint constraint = empty_constraint(problem, {v, w});
    constraint.violations.clear();
    for (double& entry : constraint.costs) entry = hard && random() % 12 == 0 ? forbidden : cost();
    problem.constraints.push_back(std::move(constraint));
  }
  return problem;
}

TEST(Elimination, TreesAndCyclesAsByBruteForce) {
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](std::size_t n) { return static_cast<Index>(random() % n); };
    std::vector<Index> domains(3 + below(5));
    for (Index& domain : domains) domain = 1 + below(4);  // one value alone too
    std::vector<std::pair<Index, Index>> links;
    for (Index v = 1; v < domains.size(); ++v)
      if (below(8) > 0) links.emplace_back(below(v), v);  // forests
    if (seed % 3 == 1) links.emplace_back(Index{0}, static_cast<Index>(domains.size() - 1));
    if (seed % 3 == 2) links.emplace_back(static_cast<Index>(domains.size() - 1), Index{1});
    expect_as_by_brute_force(problem_on(domains, links, seed, true), seed);
  }
}

TEST(Elimination, ProblemsWithExclusionsAndTablesOfThreeAsByBruteForce) {
  for (std::uint64_t seed = 0; seed < 600; ++seed)
    expect_as_by_brute_force(test::random_problem(test::random_kind(seed), seed), seed);
}

/// Tables of the plan for variables of two values.
double entries(Index variables, const std::vector<std::pair<Index, Index>>& links) {
  return eliminate(problem_on(std::vector<Index>(variables, 2), links, 1, false), 1).plan.entries;
}

TEST(Elimination, OrdersAreBestOnGraphsOfKnownWidth) {
  const Index n = 400;
  std::vector<std::pair<Index, Index>> chain, star, wheel, grid;
  for (Index v = 0; v + 1 < n; ++v) {
    chain.emplace_back(v, v + 1);
    star.emplace_back(v + 1, Index{0});
    wheel.emplace_back(v + 1, v + 2 < n ? v + 2 : 1);
    wheel.emplace_back(Index{0}, v + 1);
  }
  for (Index v = 0; v < n; ++v) {
    if (v % 4 != 3) grid.emplace_back(v, v + 1);
    if (v + 4 < n) grid.emplace_back(v, v + 4);
  }
  EXPECT_EQ(entries(n, chain), 4.0 * (n - 1) + 2);
  EXPECT_EQ(entries(n, star), 4.0 * (n - 1) + 2);
  EXPECT_EQ(entries(n, wheel), 16.0 * (n - 3) + 8 + 4 + 2);
  EXPECT_LE(entries(n, grid), 32.0 * n);  // four wide
}

TEST(Elimination, WhatIsTooWideIsSaidSo) {
  std::vector<std::pair<Index, Index>> complete;
  for (Index v = 0; v < 40; ++v)
    for (Index w = 0; w < v; ++w) complete.emplace_back(w, v);
  NoLimits context;
  Deadline deadline(forbidden, context);
  factors::Watch watch(deadline);
  const LabelingProblem problem = problem_on(std::vector<Index>(40, 2), complete, 1, false);
  const factors::FactorGraph graph = factors::factor_graph(problem, watch);
  EXPECT_TRUE(std::isinf(factors::elimination_plan(graph, 1e6, watch).entries));
}

}  // namespace
