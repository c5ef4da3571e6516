// SPDX-License-Identifier: BSD-3-Clause
// Why a feature is missing: what is named forbids each of its candidates.

#include "result/conflict.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/run_context.h"
#include "support/labeling_problems.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

bool named(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(Conflict, EveryCandidateBreaksWhatIsNamed) {
  const RunContext context;
  int conflicts = 0, none = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = test::random_problem(
        {.variables = 4, .domain = 5, .arity = 3, .constraints = 6, .forbidden_entries = 0.4}, seed);
    const std::vector<Labeling> all = test::all_labelings(problem);
    if (all.empty()) continue;
    const Labeling& best = all.front();
    for (Index v = 0; v < best.values.size(); ++v) {
      if (!problem.variables[v].missing(best.values[v]) || problem.variables[v].domain() == 1) continue;
      const auto report = conflict_of_missing(problem, best, v, context);
      bool all_forbidden = true, all_infinite = true;
      std::vector<Index> values = best.values;
      for (Index value = 1; value < problem.variables[v].domain(); ++value) {
        if (!(problem.variables[v].costs[value] < forbidden)) continue;
        all_infinite = false;
        values[v] = value;
        bool forbidden_here = false, by_named = false;
        const auto meet = [&](bool broken, bool is_named) {
          forbidden_here = forbidden_here || broken;
          by_named = by_named || (broken && is_named);
        };
        for (const LabelingConstraint& constraint : problem.constraints) {
          if (std::count(constraint.scope.begin(), constraint.scope.end(), v) == 0) continue;
          const std::size_t entry = table_entry(problem, constraint, values);
          meet(!satisfied(constraint, entry) || !(constraint.costs[entry] < forbidden),
               report && named(report->relations, constraint.name));
        }
        for (Index w = 0; w < values.size(); ++w)
          meet(excluded(problem, v, value, w, values[w]),
               report && named(report->exclusions, problem.variables[w].name));
        all_forbidden = all_forbidden && forbidden_here;
        if (report) {
          EXPECT_TRUE(by_named) << in_words(*report);
        }
      }
      EXPECT_EQ(report.has_value(), all_forbidden && !all_infinite);
      if (report) {
        EXPECT_TRUE(report->smallest);
      }
      ++(report ? conflicts : none);
    }
  }
  EXPECT_GT(conflicts, 30);
  EXPECT_GT(none, 30);
}

TEST(Conflict, InWords) {
  EXPECT_EQ(in_words(ConflictReport{{"r1", "r4"}, {"bottom"}, true}),
            "every candidate breaks r1 or r4 or shares its place with bottom");
  EXPECT_EQ(in_words(ConflictReport{{}, {"rim", "bottom"}, true}),
            "every candidate shares its place with rim or bottom");
}

}  // namespace
}  // namespace toposcope
