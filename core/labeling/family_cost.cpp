// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "family_group.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {

double cost_of(const FamilyProblem& problem, const FamilyLabeling& labeling) {
  std::vector<Index> values = labeling.values;
  const auto each_instance = [&](std::size_t f, const auto& visit) {
    for (const Index value : labeling.instances[f]) {
      values[problem.families[f].variable] = value;
      visit();
    }
    values[problem.families[f].variable] = 0;
  };
  double cost = problem.problem.constant;
  if (!meets_exclusions(problem.problem, values)) return forbidden;
  std::vector<std::optional<std::size_t>> family_of(values.size());
  for (std::size_t f = 0; f < problem.families.size(); ++f) family_of[problem.families[f].variable] = f;
  for (Index v = 0; v < values.size(); ++v)
    if (!family_of[v]) cost += problem.problem.variables[v].costs[values[v]];
  for (std::size_t f = 0; f < problem.families.size(); ++f) {
    const Family& family = problem.families[f];
    if (labeling.instances[f].size() >= family.number_costs.size()) return forbidden;
    cost += family.number_costs[labeling.instances[f].size()];
    bool apart = true;
    each_instance(f, [&] {
      const Index value = values[family.variable];
      cost += problem.problem.variables[family.variable].costs[value];
      apart = apart && meets_exclusions(problem.problem, values);
      for (std::size_t g = 0; g <= f; ++g)
        for (const Index other : labeling.instances[g]) {
          if (g == f && other >= value) break;
          apart = apart && !exclude(problem.problem, family.variable, value, problem.families[g].variable, other);
        }
    });
    if (!apart) return forbidden;
  }
  for (const LabelingConstraint& constraint : problem.problem.constraints) {
    std::optional<std::size_t> family;
    std::size_t times = 0;
    for (const Index v : constraint.scope)
      if (family_of[v]) family = family_of[v], ++times;
    if (times < 2) {
      const auto add = [&] { cost += constraint.costs[table_entry(problem.problem, constraint, values)]; };
      if (family)
        each_instance(*family, add);
      else
        add();
      continue;
    }
    const std::vector<Index>& instances = labeling.instances[*family];
    for (std::size_t a = 0; a < instances.size(); ++a)
      for (std::size_t b = a + 1; b < instances.size(); ++b) {
        std::size_t entry = 0;
        bool named = false;
        for (const Index v : constraint.scope) {
          const bool of_family = family_of[v].has_value();
          entry = entry * problem.problem.variables[v].domain() + (of_family ? instances[named ? b : a] : values[v]);
          named = named || of_family;
        }
        cost += constraint.costs[entry];
      }
  }
  return cost;
}

}  // namespace toposcope
