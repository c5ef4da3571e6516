// SPDX-License-Identifier: BSD-3-Clause
// The smallest conflicting set against all subsets of constraints and exclusions.

#include "toposcope/labeling/conflict_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>

#include "base/run_context.h"
#include "support/labeling_problems.h"

namespace toposcope {
namespace {

struct Item {
  Index constraint = no_candidate, first = 0, second = 0;
};

std::vector<Item> items_of(const LabelingProblem& problem, const ConflictQuestion& question) {
  std::vector<Item> items;
  const auto counts = [&](Index v) { return question.about == no_candidate || question.about == v; };
  for (Index c = 0; c < problem.constraints.size(); ++c)
    if (std::any_of(problem.constraints[c].scope.begin(), problem.constraints[c].scope.end(), counts))
      items.push_back({c});
  for (Index x = 0; x < problem.variables.size(); ++x)
    for (Index y = x + 1; y < problem.variables.size(); ++y)
      if (counts(x) || counts(y)) items.push_back({no_candidate, x, y});
  return items;
}

// Per labelling that the question admits: the items that it meets, as bits.
std::set<std::uint64_t> met_sets(const LabelingProblem& problem, const ConflictQuestion& question,
                                 const std::vector<Item>& items) {
  std::set<std::uint64_t> all;
  std::vector<Index> values(problem.variables.size(), 0);
  for (bool more = true; more;) {
    bool admitted = true;
    for (Index v = 0; v < values.size(); ++v) {
      const bool fixed = !question.fixed.empty() && question.fixed[v] != no_candidate;
      if (fixed) admitted = admitted && values[v] == question.fixed[v];
      if (!fixed && !question.missing_allowed) admitted = admitted && !problem.variables[v].missing(values[v]);
      admitted = admitted && problem.variables[v].costs[values[v]] < forbidden;
    }
    if (admitted) {
      std::uint64_t met = 0;
      for (std::size_t k = 0; k < items.size(); ++k) {
        const Item& item = items[k];
        bool meets = false;
        if (item.constraint == no_candidate) {
          meets = !excluded(problem, item.first, values[item.first], item.second, values[item.second]);
        } else {
          const LabelingConstraint& constraint = problem.constraints[item.constraint];
          const std::size_t entry = table_entry(problem, constraint, values);
          meets = constraint.costs[entry] < forbidden && satisfied(constraint, entry);
          for (const Index v : constraint.scope)  // that is for their exclusion to say
            for (const Index w : constraint.scope) meets = meets || excluded(problem, v, values[v], w, values[w]);
        }
        met |= std::uint64_t{meets} << k;
      }
      all.insert(met);
    }
    more = false;
    for (std::size_t i = values.size(); i-- > 0 && !more;) {
      more = ++values[i] < problem.variables[i].domain();
      if (!more) values[i] = 0;
    }
  }
  return all;
}

bool can_be_met(const std::set<std::uint64_t>& met_sets, std::uint64_t items) {
  return std::any_of(met_sets.begin(), met_sets.end(), [&](std::uint64_t met) { return (met & items) == items; });
}

std::uint64_t bits_of(const ConflictSet& set, const std::vector<Item>& items) {
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < items.size(); ++k) {
    const bool in =
        items[k].constraint != no_candidate
            ? std::count(set.constraints.begin(), set.constraints.end(), items[k].constraint) > 0
            : std::count(set.exclusions.begin(), set.exclusions.end(), std::pair{items[k].first, items[k].second}) > 0;
    bits |= std::uint64_t{in} << k;
  }
  return bits;
}

// Size of the smallest subset that cannot be met; -1 where all can.
int smallest_of_all(const std::set<std::uint64_t>& met_sets, std::size_t items) {
  int smallest = -1;
  for (std::uint64_t subset = 0; subset < std::uint64_t{1} << items; ++subset)
    if ((smallest < 0 || std::popcount(subset) < smallest) && !can_be_met(met_sets, subset))
      smallest = std::popcount(subset);
  return smallest;
}

void expect_smallest(const LabelingProblem& problem, const ConflictQuestion& question, std::vector<int>& sizes) {
  const RunContext context;
  Deadline deadline(60, context);
  const ConflictSet set = smallest_conflict(problem, question, deadline);
  const std::vector<Item> items = items_of(problem, question);
  const std::set<std::uint64_t> met = met_sets(problem, question, items);
  const int smallest = smallest_of_all(met, items.size());
  if (smallest < 0) {
    EXPECT_EQ(set.status, ConflictSet::Status::none);
    EXPECT_EQ(set.size(), 0U);
    return;
  }
  ASSERT_EQ(set.status, ConflictSet::Status::smallest);
  EXPECT_EQ(set.size(), static_cast<std::size_t>(smallest));
  EXPECT_EQ(std::popcount(bits_of(set, items)), smallest);
  EXPECT_FALSE(can_be_met(met, bits_of(set, items))) << in_words(problem, set);
  ++sizes[static_cast<std::size_t>(smallest)];
}

TEST(ConflictSet, SmallestOfAllSubsets) {
  std::vector<int> sizes(20, 0);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem({.variables = 2 + static_cast<int>(seed % 3),
                                                          .domain = 5,
                                                          .arity = 3,
                                                          .constraints = 3 + static_cast<int>(seed % 4),
                                                          .optional = seed % 2 == 0 ? 1.0 : 0.6,
                                                          .forbidden_entries = seed % 3 == 0 ? 0.4 : 0.65},
                                                         seed);
    expect_smallest(problem, {}, sizes);
    expect_smallest(problem, {.missing_allowed = true}, sizes);
    std::vector<Index> fixed;
    for (const LabelingVariable& variable : problem.variables)
      fixed.push_back(static_cast<Index>(seed / 7 % variable.domain()));
    const Index about = static_cast<Index>(seed % problem.variables.size());
    fixed[about] = no_candidate;
    expect_smallest(problem, {false, fixed, about}, sizes);
    if (testing::Test::HasFailure()) break;
  }
  for (const int size : {0, 1, 2, 3, 4}) EXPECT_GT(sizes[static_cast<std::size_t>(size)], 10) << "of size " << size;
}

TEST(ConflictSet, QueensNeedAllThree) {
  const RunContext context;
  Deadline deadline(60, context);
  const ConflictSet set = smallest_conflict(test::queens(3), {}, deadline);
  EXPECT_EQ(set.status, ConflictSet::Status::smallest);
  EXPECT_EQ(in_words(test::queens(3), set), "'rows 0 and 1', 'rows 0 and 2' and 'rows 1 and 2'");
  EXPECT_EQ(smallest_conflict(test::queens(6), {}, deadline).status, ConflictSet::Status::none);
}

TEST(ConflictSet, ExclusionsAreNamedByTheirFeatures) {
  LabelingProblem problem;
  problem.candidate_count = 1;
  set_conflict(problem, 0, 0);
  problem.variables = {{"rim", 1, {0}, {0, 0}}, {"bottom", 1, {0}, {0, 0}}};
  const RunContext context;
  Deadline deadline(60, context);
  const ConflictSet set = smallest_conflict(problem, {}, deadline);
  EXPECT_EQ(in_words(problem, set), "the exclusion of 'rim' and 'bottom'");
  problem.variables[0].costs[1] = forbidden;
  EXPECT_EQ(smallest_conflict(problem, {}, deadline).size(), 0U);
  EXPECT_TRUE(smallest_conflict(problem, {}, deadline).conflicts());
}

TEST(ConflictSet, OutOfTimeClaimsNothing) {
  const RunContext context;
  Deadline deadline(0, context);
  EXPECT_EQ(smallest_conflict(test::queens(30), {}, deadline).status, ConflictSet::Status::unknown);
}

}  // namespace
}  // namespace toposcope
