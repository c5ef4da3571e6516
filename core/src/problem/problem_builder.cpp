// SPDX-License-Identifier: BSD-3-Clause
#include "problem/problem_builder.h"

namespace toposcope {

std::optional<std::size_t> table_size(const LabelingProblem& problem, const std::vector<Index>& scope) {
  std::size_t entries = 1;
  for (const Index v : scope)
    if ((entries *= problem.variables[v].domain()) > most_entries) return {};
  return entries;
}

void add_variable(LabelingProblem& problem, std::string name, Index domain) {
  LabelingVariable& variable = problem.variables.emplace_back();
  variable.name = std::move(name);
  variable.optional = false;
  variable.costs.assign(domain, 0);
}

void add_table(ProblemFile& file, std::string name, std::vector<Index> scope, std::vector<double> costs) {
  for (double& cost : costs)
    if (cost >= file.top) cost = forbidden;
  if (scope.empty()) {
    file.problem.constant += costs[0];
  } else if (scope.size() == 1) {
    for (std::size_t a = 0; a < costs.size(); ++a) file.problem.variables[scope[0]].costs[a] += costs[a];
  } else {
    file.problem.constraints.push_back({std::move(name), std::move(scope), std::move(costs)});
  }
}

std::string add_function(ProblemFile& file, std::string name, std::vector<Index> scope, const CostFunction& cost) {
  const auto entries = table_size(file.problem, scope);
  if (!entries)
    return "needs a table of over " + std::to_string(most_entries) + " entries over its " +
           std::to_string(scope.size()) + " variables, which is not supported";
  LabelingConstraint constraint{"", scope};
  std::vector<double> costs;
  costs.reserve(*entries);
  std::vector<Index> digits(scope.size(), 0);
  do costs.push_back(cost(digits));
  while (next_entry(file.problem, constraint, digits));
  add_table(file, std::move(name), std::move(scope), std::move(costs));
  return {};
}

std::string add_global(ProblemFile& file, const std::string& name, const std::vector<Index>& scope,
                       const GlobalArguments& given) {
  const GlobalFunction global = global_function(name, scope, given, file.top);
  if (!global.cost) return global.why;
  if (!global.pairwise) return add_function(file, name, scope, global.cost);
  for (std::size_t i = 0; i < scope.size(); ++i)
    for (std::size_t j = i + 1; j < scope.size(); ++j)
      if (const std::string why = add_function(file, name, {scope[i], scope[j]}, global.cost); !why.empty()) return why;
  return {};
}

}  // namespace toposcope
