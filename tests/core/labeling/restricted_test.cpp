// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/restricted.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "support/labeling_problems.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

using ::testing::ElementsAre;

/// Every labelling of the kept values is the one of before, to the last bit.
TEST(Restricted, CostsAndConflictsAreThoseOfBefore) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    std::vector<std::vector<Index>> kept;
    for (const LabelingVariable& variable : problem.variables) {
      std::vector<Index>& values = kept.emplace_back();
      for (Index value = 0; value < variable.domain(); ++value)
        if (variable.missing(value) || (value + kept.size() + seed) % 3 > 0) values.push_back(value);
      if (values.empty()) values.push_back(0);
    }
    const LabelingProblem smaller = restricted(problem, kept);
    ASSERT_NO_THROW(check(smaller));
    std::vector<Index> values(kept.size(), 0), before(kept.size());
    for (std::size_t v = 0; v < kept.size();) {
      for (std::size_t w = 0; w < kept.size(); ++w) before[w] = kept[w][values[w]];
      EXPECT_EQ(cost_of(smaller, values), cost_of(problem, before));
      EXPECT_EQ(consistent(smaller, values), consistent(problem, before));
      ++compared;
      for (v = 0; v < kept.size() && ++values[v] == kept[v].size(); ++v) values[v] = 0;
    }
  }
  EXPECT_GT(compared, 1000U);
}

TEST(Restricted, KeepsNamesAndNumbersOfWhatStays) {
  LabelingProblem problem;
  problem.name = "queens";
  problem.constant = 2;
  problem.candidate_count = 3;
  for (Index c = 0; c < 3; ++c) set_conflict(problem, c, c);
  problem.variables.push_back({.name = "a", .detectability = 0.5, .candidates = {0, 1, 2}, .costs = {0, 1, 2, 3}});
  problem.variables.push_back(
      {.name = "b", .costs = {4, 5, 6}, .optional = false, .value_names = {"low", "middle", "high"}});
  problem.constraints.push_back({.name = "r", .scope = {1, 0}, .costs = {}});
  for (int entry = 0; entry < 12; ++entry) problem.constraints[0].costs.push_back(entry);
  const LabelingProblem smaller = restricted(problem, {{0, 3}, {0, 2}});
  EXPECT_EQ(smaller.name, "queens");
  EXPECT_EQ(smaller.constant, 2);
  EXPECT_EQ(smaller.variables[0].detectability, 0.5);
  EXPECT_THAT(smaller.variables[0].candidates, ElementsAre(2));
  EXPECT_THAT(smaller.variables[0].costs, ElementsAre(0, 3));
  EXPECT_FALSE(smaller.variables[1].optional);
  EXPECT_THAT(smaller.variables[1].value_names, ElementsAre("low", "high"));
  // Of b's row 0 the entries 0 and 3, of its row 2 the entries 8 and 11.
  EXPECT_THAT(smaller.constraints[0].costs, ElementsAre(0, 3, 8, 11));
  EXPECT_TRUE(smaller.constraints[0].violations.empty());
}

}  // namespace
}  // namespace toposcope
