// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/restricted.h"

namespace toposcope {
namespace {

LabelingVariable restricted(const LabelingVariable& variable, const std::vector<Index>& kept) {
  LabelingVariable result;
  result.name = variable.name;
  result.detectability = variable.detectability;
  result.optional = variable.optional;
  for (const Index value : kept) {
    result.costs.push_back(variable.costs[value]);
    if (variable.candidate(value) != no_candidate) result.candidates.push_back(variable.candidate(value));
    if (!variable.value_names.empty()) result.value_names.push_back(variable.value_names[value]);
  }
  return result;
}

/// Per entry of a constraint's tables after the restriction its entry before.
std::vector<std::size_t> kept_entries(const LabelingProblem& problem, const std::vector<Index>& scope,
                                      const std::vector<std::vector<Index>>& kept) {
  std::vector<std::size_t> entries = {0};
  for (const Index v : scope) {
    std::vector<std::size_t> longer;
    longer.reserve(entries.size() * kept[v].size());
    for (const std::size_t entry : entries)
      for (const Index value : kept[v]) longer.push_back(entry * problem.variables[v].domain() + value);
    entries = std::move(longer);
  }
  return entries;
}

}  // namespace

LabelingProblem restricted(const LabelingProblem& problem, const std::vector<std::vector<Index>>& kept) {
  LabelingProblem result;
  result.name = problem.name;
  result.constant = problem.constant;
  result.candidate_count = problem.candidate_count;
  result.conflict_bits = problem.conflict_bits;
  for (Index v = 0; v < problem.variables.size(); ++v)
    result.variables.push_back(restricted(problem.variables[v], kept[v]));
  for (const LabelingConstraint& from : problem.constraints) {
    LabelingConstraint& to = result.constraints.emplace_back();
    to.name = from.name;
    to.scope = from.scope;
    for (const std::size_t entry : kept_entries(problem, from.scope, kept)) {
      to.costs.push_back(from.costs[entry]);
      if (!from.violations.empty()) to.violations.push_back(from.violations[entry]);
    }
  }
  return result;
}

}  // namespace toposcope
