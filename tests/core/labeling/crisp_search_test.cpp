// SPDX-License-Identifier: BSD-3-Clause
// The search's labellings against all consistent ones, listed.

#include "toposcope/labeling/crisp_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/run_context.h"
#include "support/labeling_problems.h"

namespace toposcope {
namespace {

using Values = std::vector<Index>;

std::set<Values> consistent_labelings(const LabelingProblem& problem) {
  std::set<Values> all;
  Values values(problem.variables.size(), 0);
  for (std::size_t v = 0; v < values.size();) {
    if (consistent(problem, values)) all.insert(values);
    for (v = 0; v < values.size() && ++values[v] == problem.variables[v].domain(); ++v) values[v] = 0;
  }
  return all;
}

std::size_t missing(const LabelingProblem& problem, const Values& values) {
  std::size_t count = 0;
  for (Index v = 0; v < values.size(); ++v) count += problem.variables[v].missing(values[v]);
  return count;
}

class Collect final : public CrispVisitor {
 public:
  void order(Index, Values&) override {}
  bool enter(Index, Index) override {
    ++depth;
    return true;
  }
  void leave(Index) override { --depth; }
  bool solution(std::span<const Index> values) override {
    EXPECT_TRUE(found.insert({values.begin(), values.end()}).second) << "given twice";
    return true;
  }
  std::set<Values> found;
  int depth = 0;
};

TEST(CrispSearch, FindsEveryConsistentLabelingOnceUnderAllRules) {
  const RunContext context;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const std::set<Values> all = consistent_labelings(problem);
    Deadline deadline(60, context);
    const CrispNetwork network(problem, deadline);
    for (const auto relaxation :
         {CrispRules::Relaxation::none, CrispRules::Relaxation::before, CrispRules::Relaxation::maintained})
      for (const auto order :
           {CrispRules::Order::weighted, CrispRules::Order::smallest_domain, CrispRules::Order::detectability})
        for (const bool backjumping : {false, true})
          for (const Index limit : {no_candidate, Index{1}}) {
            SCOPED_TRACE(testing::Message() << seed << ' ' << int(relaxation) << int(order) << backjumping << limit);
            std::set<Values> wanted;
            for (const Values& values : all)
              if (missing(problem, values) <= limit) wanted.insert(values);
            Collect collect;
            CrispSearch search(network, {relaxation, order, backjumping, limit, false}, collect, deadline);
            ASSERT_EQ(search.run(), CrispSearch::End::exhausted);
            ASSERT_EQ(collect.found, wanted);
            EXPECT_EQ(collect.depth, 0);
          }
  }
}

TEST(CrispSearch, FewestMissingIsTheLeastOfAll) {
  const RunContext context;
  for (std::uint64_t seed = 100; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const std::set<Values> all = consistent_labelings(problem);
    Deadline deadline(60, context);
    const FirstConsistent first = first_consistent(CrispNetwork(problem, deadline), {}, true, deadline);
    ASSERT_EQ(first.found, !all.empty());
    EXPECT_TRUE(first.proven);
    if (all.empty()) continue;
    std::size_t least = problem.variables.size();
    for (const Values& values : all) least = std::min(least, missing(problem, values));
    EXPECT_TRUE(all.contains(first.values));
    EXPECT_EQ(missing(problem, first.values), least);
  }
}

TEST(CrispSearch, AllPresentLeavesMissingOut) {
  const RunContext context;
  for (std::uint64_t seed = 200; seed < 260; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    std::set<Values> wanted;
    for (const Values& values : consistent_labelings(problem))
      if (missing(problem, values) == 0) wanted.insert(values);
    Deadline deadline(60, context);
    const CrispNetwork network(problem, deadline, true);
    Collect collect;
    CrispSearch search(network, {}, collect, deadline);
    EXPECT_EQ(search.run(), CrispSearch::End::exhausted);
    EXPECT_EQ(collect.found, wanted);
  }
}

}  // namespace
}  // namespace toposcope
