// SPDX-License-Identifier: BSD-3-Clause
// Error-minimising optimisation against brute force.

#include <gtest/gtest.h>

#include <algorithm>

#include "support/classic_problems.h"
#include "support/labeling_problems.h"
#include "support/planted_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

TEST(LeastError, BestLabelingsAsByBruteForce) {
  const auto labeler = test::labeler("least-error");
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const std::vector<Labeling> all = test::all_labelings(problem);
    for (const std::size_t k : {std::size_t{1}, std::size_t{7}, all.size() + 3}) {
      const LabelingOutcome outcome = labeler->solve(problem, {.k_best = k, .time_limit_s = 60}, test::context());
      ASSERT_TRUE(outcome.optimal) << seed;
      if (all.empty()) {
        EXPECT_EQ(outcome.lower_bound, forbidden) << seed;
        EXPECT_EQ(outcome.labelings.size(), all_missing(problem).size()) << seed;
        continue;
      }
      ASSERT_EQ(outcome.labelings.size(), std::min(k, all.size())) << seed << ", " << k << " best";
      EXPECT_EQ(outcome.lower_bound, all[0].cost) << seed;
      for (std::size_t i = 0; i < outcome.labelings.size(); ++i) {
        EXPECT_EQ(outcome.labelings[i].cost, all[i].cost) << seed << ", labelling " << i;
        EXPECT_EQ(cost_of(problem, outcome.labelings[i].values), all[i].cost) << seed << ", labelling " << i;
        EXPECT_TRUE(i == 0 || outcome.labelings[i].values != outcome.labelings[i - 1].values) << seed;
      }
    }
  }
}

TEST(LeastError, AllWithinAThreshold) {
  const auto labeler = test::labeler("least-error");
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const std::vector<Labeling> all = test::all_labelings(problem);
    if (all.empty()) continue;
    const double within = 2.5;
    const auto count = std::count_if(all.begin(), all.end(),
                                     [&](const Labeling& labeling) { return labeling.cost <= all[0].cost + within; });
    const LabelingOutcome outcome =
        labeler->solve(problem, {.k_best = all.size(), .time_limit_s = 60, .within = within}, test::context());
    ASSERT_EQ(outcome.labelings.size(), count) << seed;
    for (std::size_t i = 0; i < outcome.labelings.size(); ++i) EXPECT_EQ(outcome.labelings[i].cost, all[i].cost);
  }
}

// Whatever is switched off the answer is the same.
TEST(LeastError, EachPartAloneIsRight) {
  for (const test::Settings& settings :
       {test::Settings{{"root_sweeps", "0"}}, test::Settings{{"virtual_arc_consistency", "false"}},
        test::Settings{{"root_sweeps", "0"}, {"virtual_arc_consistency", "false"}, {"node_sweeps", "0"}}}) {
    const auto labeler = test::labeler("least-error", settings);
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
      const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
      const std::vector<Labeling> all = test::all_labelings(problem);
      const LabelingOutcome outcome = labeler->solve(problem, {.k_best = 3}, test::context());
      ASSERT_TRUE(outcome.optimal);
      EXPECT_TRUE(all.empty() || outcome.labelings[0].cost == all[0].cost) << seed;
    }
  }
}

void expect_as_by_brute_force(const LabelingProblem& problem, std::uint64_t seed) {
  const std::vector<Labeling> all = test::all_labelings(problem);
  for (const std::size_t k : {std::size_t{1}, std::size_t{9}}) {
    const LabelingOutcome outcome =
        test::labeler("least-error")->solve(problem, {.k_best = k, .time_limit_s = 60}, test::context());
    ASSERT_TRUE(outcome.optimal) << seed;
    ASSERT_EQ(outcome.labelings.size(), std::min(k, all.size())) << seed;
    for (std::size_t i = 0; i < outcome.labelings.size(); ++i)
      EXPECT_EQ(outcome.labelings[i].cost, all[i].cost) << seed;
  }
}

// Bids for one good are a clique, and each gets a variable of its own.
TEST(LeastError, AuctionsAndWarehousesAsByBruteForce) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    expect_as_by_brute_force(test::auction(static_cast<Index>(5 + seed % 7), 12, seed), seed);
    expect_as_by_brute_force(test::warehouses(3, 5, seed), seed);
  }
}

// At most one of forty: a bound from pairs alone leaves half of each, and a search through all.
TEST(LeastError, OfACliqueAllButOnePay) {
  LabelingProblem problem;
  double sum = 0;
  for (Index v = 0; v < 40; ++v) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "x" + std::to_string(v);
    variable.optional = false;
    variable.costs = {10.0 + v % 5, 0};
    sum += variable.costs[0];
    for (Index w = 0; w < v; ++w) problem.constraints.push_back({"", {w, v}, {0, 0, 0, forbidden}, {}});
  }
  const LabelingOutcome outcome =
      test::labeler("least-error")->solve(problem, {.k_best = 1, .time_limit_s = 60}, test::context());
  EXPECT_TRUE(outcome.optimal);
  EXPECT_EQ(outcome.labelings[0].cost, sum - 14);
  EXPECT_LE(outcome.nodes, 100U);
}

// Some labelling is there however early it is stopped, of thousands of variables too.
TEST(LeastError, StoppedAtTheRootItHasALabelling) {
  const LabelingProblem problem = test::auction(300, 1000, 1);
  const LabelingOutcome outcome =
      test::labeler("least-error")->solve(problem, {.k_best = 1, .time_limit_s = 0.3}, test::context());
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_LT(outcome.labelings[0].cost, forbidden);
  EXPECT_LE(outcome.lower_bound, outcome.labelings[0].cost);
}

TEST(LeastError, EightQueensHave92Solutions) {
  const LabelingOutcome outcome =
      test::labeler("least-error")->solve(test::queens(8), {.k_best = 1000, .time_limit_s = 60}, test::context());
  EXPECT_TRUE(outcome.optimal);
  EXPECT_EQ(outcome.labelings.size(), 92U);
}

TEST(LeastError, FindsThePlantedLabelling) {
  const auto labeler = test::labeler("least-error");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    std::vector<Index> truth;
    const LabelingProblem problem = test::planted_problem({.features = 12, .candidates = 50}, seed, &truth);
    const LabelingOutcome outcome = labeler->solve(problem, {.k_best = 2, .time_limit_s = 60}, test::context());
    ASSERT_TRUE(outcome.optimal);
    EXPECT_LE(outcome.labelings[0].cost, cost_of(problem, truth));
    EXPECT_LE(outcome.labelings[0].cost, outcome.labelings[1].cost);
  }
}

// Stopped after any time the bound is below the optimum, the labelling is sound and the cost above it.
TEST(LeastError, StoppedEarlyItKeepsWhatItHas) {
  const auto labeler = test::labeler("least-error");
  const LabelingProblem problem = test::planted_problem({.features = 10, .candidates = 30, .structured = false}, 1);
  const double optimum = labeler->solve(problem, {.k_best = 1, .time_limit_s = 60}, test::context()).lower_bound;
  for (const double limit_s : {0.0, 1e-4, 1e-3, 3e-3}) {
    const LabelingOutcome outcome = labeler->solve(problem, {.k_best = 1, .time_limit_s = limit_s}, test::context());
    ASSERT_EQ(outcome.labelings.size(), 1U);
    EXPECT_TRUE(meets_exclusions(problem, outcome.labelings[0].values));
    EXPECT_LE(outcome.lower_bound, optimum + 1e-9);
    EXPECT_GE(outcome.labelings[0].cost, optimum - 1e-9);
  }
  const LabelingProblem large = test::planted_problem({.features = 40, .candidates = 60, .structured = false}, 1);
  const LabelingOutcome outcome = labeler->solve(large, {.k_best = 1, .time_limit_s = 1e-3}, test::context());
  EXPECT_EQ(outcome.labelings.size(), 1U);
  EXPECT_FALSE(outcome.optimal);
}

TEST(LeastError, AProblemWithoutVariables) {
  const LabelingOutcome outcome = test::labeler("least-error")->solve({}, {}, test::context());
  EXPECT_TRUE(outcome.optimal);
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_EQ(outcome.labelings[0].cost, 0);
}

}  // namespace
