// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/greedy_labeling.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/run_context.h"
#include "support/labeling_problems.h"

namespace {

using namespace toposcope;

std::vector<Index> in_order(const LabelingProblem& problem) {
  std::vector<Index> order(problem.variables.size());
  std::iota(order.begin(), order.end(), Index{0});
  return order;
}

TEST(GreedyLabeling, FindsALabellingExactlyWhereThereIsOne) {
  RunContext context;
  int none = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    test::RandomKind kind = test::random_kind(seed);
    kind.forbidden_unary = 0.3;
    kind.forbidden_entries = 0.5;
    const LabelingProblem problem = test::random_problem(kind, seed);
    Deadline deadline(60, context);
    const auto found = greedy_labeling(problem, {in_order(problem), {}}, deadline);
    const bool exists = !test::all_labelings(problem).empty();
    ASSERT_EQ(found.has_value(), exists) << seed;
    if (found) {
      EXPECT_LT(cost_of(problem, *found), forbidden);
    }
    none += !exists;
  }
  EXPECT_GT(none, 50);
}

TEST(GreedyLabeling, FollowsOrderAndRank) {
  RunContext context;
  Deadline deadline(60, context);
  LabelingProblem problem = test::queens(4);
  // Rows 0..3 prefer column 3, 1, 0, 2 in that order of rank; the second choice of row 0 leads to a solution.
  std::vector<double> rank(16, 5);
  rank[3] = 0;
  rank[1] = 1;
  EXPECT_EQ(greedy_labeling(problem, {in_order(problem), rank}, deadline), (std::vector<Index>{1, 3, 0, 2}));
  // Without a way back only the first choice is tried, with the row at which it ended first.
  EXPECT_EQ(greedy_labeling(problem, {in_order(problem), rank, 1, 0}, deadline), std::nullopt);
}

TEST(GreedyLabeling, WorksCancelledWhereNothingStandsInTheWay) {
  RunContext context;
  context.cancel();
  Deadline deadline(0, context);
  const LabelingProblem problem = test::random_problem({8, 6, 2, 10, false, 1, 0, 0}, 3);
  const auto found = greedy_labeling(problem, {in_order(problem), {}}, deadline);
  ASSERT_TRUE(found);
  EXPECT_LT(cost_of(problem, *found), forbidden);
  EXPECT_EQ(greedy_labeling({}, {}, deadline), (std::vector<Index>{}));
}

}  // namespace
