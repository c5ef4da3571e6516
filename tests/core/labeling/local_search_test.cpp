// SPDX-License-Identifier: BSD-3-Clause
// What local search believes of a move against what cost_of makes of it.

#include "toposcope/labeling/local_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "base/run_context.h"
#include "support/labeling_problems.h"

namespace {

using namespace toposcope;

struct Counted {
  double finite = 0;
  std::int64_t broken = 0;
};

// Broken entries counted one by one; a variable's own cost and its unary constraints count as one.
Counted count(const LabelingProblem& problem, const std::vector<Index>& values) {
  Counted counted{problem.constant, 0};
  std::vector<double> own(values.size());
  const auto add = [&](double cost) { cost < forbidden ? void(counted.finite += cost) : void(++counted.broken); };
  for (Index v = 0; v < values.size(); ++v) own[v] = problem.variables[v].costs[values[v]];
  for (const LabelingConstraint& constraint : problem.constraints) {
    const double cost = constraint.costs[table_entry(problem, constraint, values)];
    constraint.scope.size() == 1 ? void(own[constraint.scope[0]] += cost) : add(cost);
  }
  for (Index v = 0; v < values.size(); ++v) {
    add(own[v]);
    for (Index w = 0; w < v; ++w) counted.broken += excluded(problem, v, values[v], w, values[w]);
  }
  return counted;
}

// For each thing that v's value breaks the other variable, v itself where that is not one; and the count of exclusions.
std::pair<std::vector<Index>, std::int32_t> opponents(const LabelingProblem& problem, const std::vector<Index>& values,
                                                      Index v) {
  std::vector<Index> found;
  double own = problem.variables[v].costs[values[v]];
  for (const LabelingConstraint& constraint : problem.constraints) {
    const auto at = std::find(constraint.scope.begin(), constraint.scope.end(), v);
    if (at == constraint.scope.end()) continue;
    const double cost = constraint.costs[table_entry(problem, constraint, values)];
    if (constraint.scope.size() == 1)
      own += cost;
    else if (cost == forbidden)
      found.push_back(constraint.scope.size() > 2 ? v : constraint.scope[at == constraint.scope.begin() ? 1 : 0]);
  }
  if (own == forbidden) found.push_back(v);
  std::int32_t excluders = 0;
  for (Index w = 0; w < values.size(); ++w)
    if (excluded(problem, v, values[v], w, values[w])) {
      found.push_back(w);
      ++excluders;
    }
  return {found, excluders};
}

TEST(ConditionalCosts, AgreeWithCountingAfterAnyMoves) {
  RunContext context;
  int opponents_met = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    Deadline deadline(60, context);
    const CostTables tables(problem, deadline);
    ASSERT_TRUE(tables.complete());
    ConditionalCosts costs(tables);
    std::vector<Index> values(problem.variables.size(), 0);
    costs.reset(values);
    std::mt19937_64 random(seed);
    for (int step = 0; step < 40; ++step) {
      const Index v = static_cast<Index>(random() % values.size());
      const Index value = static_cast<Index>(random() % problem.variables[v].domain());
      const Counted before = count(problem, values);
      std::vector<Index> moved = values;
      moved[v] = value;
      const Counted after = count(problem, moved);
      EXPECT_NEAR(costs.cost(), before.finite, 1e-9);
      EXPECT_EQ(costs.broken(), before.broken);
      EXPECT_NEAR(costs.cost_change(v, value), after.finite - before.finite, 1e-9) << seed;
      EXPECT_EQ(costs.broken_change(v, value), after.broken - before.broken) << seed;
      EXPECT_EQ(costs.broken() == 0, cost_of(problem, values) < forbidden);
      const Index opponent = costs.sole_opponent(v, value);
      const auto [broken, excluder] = opponents(problem, moved, v);
      if (broken.size() == 1 && broken[0] != v) {
        EXPECT_EQ(opponent, broken[0]) << seed;
        ++opponents_met;
      } else {
        EXPECT_EQ(opponent, v) << seed;
      }
      EXPECT_EQ(costs.excluders(v, value), excluder);
      costs.assign(v, value);
      values = moved;
    }
  }
  EXPECT_GT(opponents_met, 500);
}

TEST(ConditionalCosts, BoundNeverAboveAnyLabelling) {
  RunContext context;
  int reached = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    Deadline deadline(60, context);
    const double bound = CostTables(problem, deadline).lower_bound();
    const std::vector<Labeling> all = test::all_labelings(problem);
    if (all.empty()) continue;
    EXPECT_LE(bound, all[0].cost) << seed;  // to the last bit
    reached += bound == all[0].cost;
  }
  EXPECT_GT(reached, 0);
}

TEST(ConditionalCosts, BoundIsInfiniteWhereAVariablesCostsTogetherForbidAll) {
  RunContext context;
  LabelingProblem problem;
  problem.variables = {{.name = "a", .costs = {0, forbidden}, .optional = false}};
  problem.constraints = {{"not the first", {0}, {forbidden, 0}}};
  Deadline deadline(60, context);
  EXPECT_EQ(CostTables(problem, deadline).lower_bound(), forbidden);
}

TEST(ConditionalCosts, DescentEndsWhereNoSingleChangeIsBetter) {
  RunContext context;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    Deadline deadline(60, context);
    const CostTables tables(problem, deadline);
    ConditionalCosts costs(tables);
    costs.reset(std::vector<Index>(problem.variables.size(), 0));
    ASSERT_TRUE(descend(tables, costs, deadline));
    BestLabelings best(3, forbidden);
    EXPECT_TRUE(offer_neighbours(tables, costs, best, deadline));
    if (costs.broken() != 0) continue;
    const double cost = cost_of(problem, costs.values());
    std::vector<Index> values = costs.values();
    for (Index v = 0; v < values.size(); ++v)
      for (Index a = 0; a < problem.variables[v].domain(); ++a) {
        values[v] = a;
        EXPECT_GE(cost_of(problem, values), cost - tables.slack()) << seed;
        values[v] = costs.values()[v];
      }
    EXPECT_LE(best.labelings().at(0).cost, cost);
  }
}

TEST(ConditionalCosts, StoppedTablesSayNothing) {
  RunContext context;
  context.cancel();
  Deadline deadline(60, context);
  const LabelingProblem problem = test::queens(6);
  const CostTables tables(problem, deadline);
  EXPECT_FALSE(tables.complete());
  EXPECT_EQ(tables.lower_bound(), -forbidden);
}

}  // namespace
