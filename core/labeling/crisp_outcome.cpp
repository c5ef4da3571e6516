// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/crisp_outcome.h"

#include <algorithm>

namespace toposcope {

double sum_of_minima(const LabelingProblem& problem, Deadline& deadline) {
  constexpr std::size_t chunk = 4096;
  double sum = problem.constant;
  for (const LabelingVariable& variable : problem.variables)
    sum += *std::min_element(variable.costs.begin(), variable.costs.end());
  for (const LabelingConstraint& constraint : problem.constraints) {
    double least = forbidden;
    const std::size_t entries = constraint.costs.size();
    for (std::size_t first = 0; first < entries; first += chunk) {
      if (deadline.reached()) return -forbidden;
      const double* cost = constraint.costs.data();
      for (std::size_t entry = first; entry < std::min(entries, first + chunk); ++entry)
        least = cost[entry] < least ? cost[entry] : least;
    }
    sum += least;
  }
  return sum - rounding_slack(problem);
}

LabelingOutcome without_labeling(const LabelingProblem& problem, bool proven) {
  LabelingOutcome outcome;
  outcome.labelings = all_missing(problem);
  // All missing is then no answer under the rules, only what a caller can draw.
  outcome.optimal = proven && outcome.labelings.empty();
  outcome.guarantee = proven ? "no consistent labelling exists" : "stopped before a consistent labelling was found";
  if (!outcome.labelings.empty()) outcome.guarantee += "; all features missing";
  return outcome;
}

LabelingOutcome without_variables(const LabelingProblem& problem) {
  LabelingOutcome outcome;
  outcome.labelings = {{{}, problem.constant}};
  outcome.lower_bound = problem.constant;
  outcome.optimal = true;
  outcome.guarantee = "a problem without variables has one labelling";
  outcome.facts = {{"consistent labellings", "1"}};
  return outcome;
}

bool any_optional(const LabelingProblem& problem) {
  return std::any_of(problem.variables.begin(), problem.variables.end(),
                     [](const LabelingVariable& variable) { return variable.optional; });
}

Index count_missing(const LabelingProblem& problem, std::span<const Index> values) {
  Index missing = 0;
  for (Index v = 0; v < values.size(); ++v) missing += problem.variables[v].missing(values[v]);
  return missing;
}

}  // namespace toposcope
