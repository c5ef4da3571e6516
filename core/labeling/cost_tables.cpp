// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "toposcope/labeling/conditional_costs.h"

namespace toposcope {

CostTables::CostTables(const LabelingProblem& problem, Deadline& deadline) : problem_(problem) {
  read_variables();
  complete_ = read_constraints(deadline) && read_pairs(deadline) && list_conflicts(deadline);
}

void CostTables::read_variables() {
  const auto variables = static_cast<Index>(problem_.variables.size());
  offsets_.assign(1, 0);
  for (Index v = 0; v < variables; ++v) {
    const LabelingVariable& variable = problem_.variables[v];
    for (Index a = 0; a < variable.domain(); ++a) {
      owners_.push_back(v);
      candidates_.push_back(variable.candidate(a));
    }
    unary_.insert(unary_.end(), variable.costs.begin(), variable.costs.end());
    offsets_.push_back(unary_.size());
  }
  pairs_.resize(variables);
  wide_.resize(variables);
}

// One pass over all costs: least ones, whether any is infinite, how large they are.
bool CostTables::read_constraints(Deadline& deadline) {
  double bound = problem_.constant, magnitude = 1 + std::abs(problem_.constant);
  const auto read = [&](const std::vector<double>& costs) {
    double least = forbidden, greatest = -forbidden, largest = 0;
    for (const double cost : costs) {
      least = std::min(least, cost);
      greatest = std::max(greatest, cost);
      largest = std::max(largest, cost < forbidden ? std::abs(cost) : 0);
    }
    bound += least;
    magnitude += largest;
    return std::pair{greatest == forbidden, largest > 0};
  };
  for (const LabelingVariable& variable : problem_.variables) read(variable.costs);
  for (Index c = 0; c < problem_.constraints.size(); ++c) {
    if (deadline.reached()) return false;
    const LabelingConstraint& constraint = problem_.constraints[c];
    const auto [forbids, weighs] = read(constraint.costs);
    forbids_.push_back(forbids);
    weighs_.push_back(weighs);
    if (constraint.scope.size() == 1)
      for (std::size_t a = 0; a < constraint.costs.size(); ++a)
        unary_[offsets_[constraint.scope[0]] + a] += constraint.costs[a];
    if (constraint.scope.size() > 2)
      for (Index k = 0; k < constraint.scope.size(); ++k) wide_[constraint.scope[k]].push_back({c, k});
  }
  lower_bound_ = bound;
  slack_ = 1e-12 * magnitude;
  allowed_offsets_.assign(1, 0);
  for (Index v = 0; v + 1 < offsets_.size(); ++v) {
    for (std::size_t p = offsets_[v]; p < offsets_[v + 1]; ++p)
      if (unary_[p] < forbidden) allowed_.push_back(static_cast<std::uint32_t>(p));
    if (allowed_.size() == allowed_offsets_.back()) lower_bound_ = forbidden;  // its costs together forbid every value
    allowed_offsets_.push_back(allowed_.size());
  }
  return true;
}

bool CostTables::read_pairs(Deadline& deadline) {
  for (Index c = 0; c < problem_.constraints.size(); ++c) {
    const std::vector<Index>& scope = problem_.constraints[c].scope;
    if (scope.size() != 2) continue;
    if (deadline.reached()) return false;
    pairs_[scope[0]].push_back(see_pair(c, false));
    pairs_[scope[1]].push_back(see_pair(c, true));
  }
  return true;
}

// Copies only what the problem's own table cannot serve for.
CostTables::Pair CostTables::see_pair(Index constraint, bool second) {
  const std::vector<double>& costs = problem_.constraints[constraint].costs;
  const std::vector<Index>& scope = problem_.constraints[constraint].scope;
  const Index own = scope[second ? 1 : 0], other = scope[second ? 0 : 1];
  const std::size_t rows = problem_.variables[own].domain(), columns = problem_.variables[other].domain();
  const std::size_t row_stride = second ? 1 : columns, column_stride = second ? rows : 1;
  const auto copy = [&](auto* seen, auto convert) {
    for (std::size_t a = 0; a < rows; ++a)
      for (std::size_t b = 0; b < columns; ++b)
        seen[a * columns + b] = convert(costs[a * row_stride + b * column_stride]);
    return seen;
  };
  Pair pair{nullptr, nullptr, other};
  if (weighs_[constraint] && !forbids_[constraint] && !second)
    pair.costs = costs.data();
  else if (weighs_[constraint])
    pair.costs = copy(own_costs_.emplace_back(std::make_unique_for_overwrite<double[]>(costs.size())).get(),
                      [](double cost) { return cost < forbidden ? cost : 0.0; });
  if (forbids_[constraint])
    pair.entries = copy(own_entries_.emplace_back(std::make_unique_for_overwrite<std::uint8_t[]>(costs.size())).get(),
                        [](double cost) { return static_cast<std::uint8_t>(cost < forbidden ? 0 : 1); });
  return pair;
}

bool CostTables::list_conflicts(Deadline& deadline) {
  conflict_offsets_.assign(1, 0);
  for (Index a = 0; a < problem_.candidate_count; ++a) {
    if ((a & 63U) == 0 && deadline.reached()) return false;
    for (std::size_t word = 0; word < problem_.conflict_words(); ++word)
      for (std::uint64_t bits = problem_.conflict_bits[a * problem_.conflict_words() + word]; bits != 0;
           bits &= bits - 1)
        conflicts_.push_back(static_cast<Index>(word * 64 + static_cast<std::size_t>(__builtin_ctzll(bits))));
    conflict_offsets_.push_back(conflicts_.size());
  }
  return true;
}

}  // namespace toposcope
