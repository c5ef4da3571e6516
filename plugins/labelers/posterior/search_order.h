// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope::posterior {

/// Variables in the order in which they enter the tree (dissertation 3.4.2): relationships by the product of their
/// features' detectabilities, within each the most detectable feature first; those in no relationship last. Ties keep
/// the order of the problem.
inline std::vector<Index> search_order(const LabelingProblem& problem) {
  std::vector<double> detectability;
  for (const LabelingConstraint& constraint : problem.constraints) {
    double product = 1;
    for (const Index v : constraint.scope) product *= problem.variables[v].detectability;
    detectability.push_back(product);
  }
  std::vector<Index> ranked(problem.constraints.size());
  std::iota(ranked.begin(), ranked.end(), Index{0});
  std::stable_sort(ranked.begin(), ranked.end(), [&](Index a, Index b) { return detectability[a] > detectability[b]; });
  std::vector<Index> order;
  const auto enter = [&](std::vector<Index> variables) {
    std::stable_sort(variables.begin(), variables.end(), [&](Index a, Index b) {
      return problem.variables[a].detectability > problem.variables[b].detectability;
    });
    for (const Index v : variables)
      if (std::find(order.begin(), order.end(), v) == order.end()) order.push_back(v);
  };
  for (const Index c : ranked) enter(problem.constraints[c].scope);
  std::vector<Index> all(problem.variables.size());
  std::iota(all.begin(), all.end(), Index{0});
  enter(all);
  return order;
}

}  // namespace toposcope::posterior
