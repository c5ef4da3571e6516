// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw std::invalid_argument(message);
}

void check_variable(const LabelingProblem& problem, const LabelingVariable& variable) {
  const std::string name = "variable '" + variable.name + "'";
  if (variable.costs.empty()) fail(name + " has no values");
  const std::size_t candidates = variable.costs.size() - (variable.optional ? 1 : 0);
  if (!variable.candidates.empty() && variable.candidates.size() != candidates)
    fail(name + " has " + std::to_string(variable.candidates.size()) + " candidates for " + std::to_string(candidates) +
         " values; it needs one for each value that is not missing");
  if (!variable.value_names.empty() && variable.value_names.size() != variable.costs.size())
    fail(name + " has " + std::to_string(variable.value_names.size()) + " value names for " +
         std::to_string(variable.costs.size()) + " values");
  for (const double cost : variable.costs)
    if (!(cost > -forbidden)) fail(name + " has a cost that is -infinity or not a number");
  for (const Index candidate : variable.candidates)
    if (candidate >= problem.candidate_count)
      fail(name + " names candidate " + std::to_string(candidate) + " of " + std::to_string(problem.candidate_count));
}

void check_constraint(const LabelingProblem& problem, const LabelingConstraint& constraint) {
  const std::string name = "constraint '" + constraint.name + "'";
  if (constraint.scope.empty()) fail(name + " has no variables");
  std::size_t entries = 1;
  for (const Index v : constraint.scope) {
    if (v >= problem.variables.size() || std::count(constraint.scope.begin(), constraint.scope.end(), v) != 1)
      fail(name + " names variable " + std::to_string(v) + ", which is repeated or not in the problem");
    entries *= problem.variables[v].domain();
  }
  if (constraint.costs.size() != entries)
    fail(name + " has " + std::to_string(constraint.costs.size()) + " costs; its scope needs " +
         std::to_string(entries));
  if (!constraint.violations.empty() && constraint.violations.size() != entries)
    fail(name + " has " + std::to_string(constraint.violations.size()) + " violations; its scope needs " +
         std::to_string(entries));
  for (const double cost : constraint.costs)
    if (!(cost > -forbidden)) fail(name + " has a cost that is -infinity or not a number");
  for (const float violation : constraint.violations)
    if (!(violation >= 0)) fail(name + " has a violation that is negative or not a number");
}

}  // namespace

void check(const LabelingProblem& problem) {
  if (!std::isfinite(problem.constant)) fail("the problem's constant cost is not finite");
  for (const LabelingVariable& variable : problem.variables) check_variable(problem, variable);
  if (problem.conflict_bits.size() != problem.candidate_count * problem.conflict_words())
    fail("the conflict table has " + std::to_string(problem.conflict_bits.size()) + " words; " +
         std::to_string(problem.candidate_count) + " candidates need " +
         std::to_string(problem.candidate_count * problem.conflict_words()));
  for (const LabelingConstraint& constraint : problem.constraints) check_constraint(problem, constraint);
}

bool excluded(const LabelingProblem& problem, Index variable, Index value, Index other, Index other_value) {
  if (variable == other) return false;
  const Index a = problem.variables[variable].candidate(value);
  const Index b = problem.variables[other].candidate(other_value);
  return a != no_candidate && b != no_candidate && problem.conflict(a, b);
}

bool meets_exclusions(const LabelingProblem& problem, std::span<const Index> values) {
  // Pairs of thousands of variables cost more than all else: only those with candidates are looked at.
  if (problem.candidate_count == 0) return true;
  for (Index v = 0; v < values.size(); ++v) {
    if (problem.variables[v].candidate(values[v]) == no_candidate) continue;
    for (Index w = 0; w < v; ++w)
      if (excluded(problem, v, values[v], w, values[w])) return false;
  }
  return true;
}

double cost_of(const LabelingProblem& problem, std::span<const Index> values) {
  double cost = problem.constant;
  for (Index v = 0; v < values.size(); ++v) cost += problem.variables[v].costs[values[v]];
  for (const LabelingConstraint& constraint : problem.constraints)
    cost += constraint.costs[table_entry(problem, constraint, values)];
  return meets_exclusions(problem, values) ? cost : forbidden;
}

bool consistent(const LabelingProblem& problem, std::span<const Index> values) {
  for (const LabelingConstraint& constraint : problem.constraints)
    if (!satisfied(constraint, table_entry(problem, constraint, values))) return false;
  return cost_of(problem, values) < forbidden;
}

double rounding_slack(const LabelingProblem& problem) {
  double magnitude = 1 + std::abs(problem.constant);
  const auto largest = [](const std::vector<double>& costs) {
    double found = 0;
    for (const double cost : costs)
      if (std::isfinite(cost)) found = std::max(found, std::abs(cost));
    return found;
  };
  for (const LabelingVariable& variable : problem.variables) magnitude += largest(variable.costs);
  for (const LabelingConstraint& constraint : problem.constraints) magnitude += largest(constraint.costs);
  return 1e-12 * magnitude;
}

std::vector<Labeling> all_missing(const LabelingProblem& problem) {
  for (const LabelingVariable& variable : problem.variables)
    if (!variable.optional) return {};
  Labeling nothing{std::vector<Index>(problem.variables.size(), 0), 0};
  nothing.cost = cost_of(problem, nothing.values);
  return {std::move(nothing)};
}

bool BestLabelings::offer(const Labeling& labeling) {
  const auto before = [](const Labeling& a, const Labeling& b) {
    return std::tie(a.cost, a.values) < std::tie(b.cost, b.values);
  };
  if (!(labeling.cost <= limit())) return false;
  const auto at = std::lower_bound(labelings_.begin(), labelings_.end(), labeling, before);
  if (at != labelings_.end() && at->values == labeling.values) return false;
  if (at == labelings_.end() && labelings_.size() >= capacity_) return false;
  labelings_.insert(at, labeling);
  const double last = labelings_.front().cost + within_;
  while (labelings_.size() > capacity_ || labelings_.back().cost > last) labelings_.pop_back();
  return true;
}

double BestLabelings::limit() const {
  if (labelings_.empty()) return std::numeric_limits<double>::max();  // what is forbidden is no labelling
  const double last = labelings_.front().cost + within_;
  return labelings_.size() < capacity_ ? std::min(last, std::numeric_limits<double>::max())
                                       : std::min(last, labelings_.back().cost);
}

}  // namespace toposcope
