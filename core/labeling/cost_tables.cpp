// SPDX-License-Identifier: BSD-3-Clause
#include "cost_tables.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace toposcope {

CostTables::CostTables(const LabelingProblem& of, Deadline& deadline)
    : problem_(of),
      state_(std::make_unique<State>(of, deadline)),
      slack_(state_->slack),
      offsets_(state_->offsets.data()),
      allowed_offsets_(state_->allowed_offsets.data()),
      owners_(state_->owners.data()),
      allowed_(state_->allowed) {}
CostTables::~CostTables() = default;

bool CostTables::complete() const {
  return state_->complete;
}

double CostTables::lower_bound() const {
  return state_->lower_bound;
}

CostTables::State::State(const LabelingProblem& of, Deadline& deadline) : problem(of) {
  read_variables();
  complete = read_constraints(deadline) && read_pairs(deadline) && list_conflicts(deadline);
}

void CostTables::State::read_variables() {
  const auto variables = static_cast<Index>(problem.variables.size());
  offsets.assign(1, 0);
  for (Index v = 0; v < variables; ++v) {
    const LabelingVariable& variable = problem.variables[v];
    for (Index a = 0; a < variable.domain(); ++a) {
      owners.push_back(v);
      candidates.push_back(variable.candidate(a));
    }
    unary.insert(unary.end(), variable.costs.begin(), variable.costs.end());
    offsets.push_back(unary.size());
  }
  pairs.resize(variables);
  wide.resize(variables);
}

// One pass over all costs: least ones, whether any is infinite, how large they are.
bool CostTables::State::read_constraints(Deadline& deadline) {
  double bound = problem.constant, magnitude = 1 + std::abs(problem.constant);
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
  for (const LabelingVariable& variable : problem.variables) read(variable.costs);
  for (Index c = 0; c < problem.constraints.size(); ++c) {
    if (deadline.reached()) return false;
    const LabelingConstraint& constraint = problem.constraints[c];
    const auto [forbids, weighs] = read(constraint.costs);
    forbids_.push_back(forbids);
    weighs_.push_back(weighs);
    if (constraint.scope.size() == 1)
      for (std::size_t a = 0; a < constraint.costs.size(); ++a)
        unary[offsets[constraint.scope[0]] + a] += constraint.costs[a];
    if (constraint.scope.size() > 2)
      for (Index k = 0; k < constraint.scope.size(); ++k) wide[constraint.scope[k]].push_back({c, k});
  }
  lower_bound = bound;
  slack = 1e-12 * magnitude;
  allowed_offsets.assign(1, 0);
  for (Index v = 0; v + 1 < offsets.size(); ++v) {
    for (std::size_t p = offsets[v]; p < offsets[v + 1]; ++p)
      if (unary[p] < forbidden) allowed.push_back(static_cast<std::uint32_t>(p));
    if (allowed.size() == allowed_offsets.back()) lower_bound = forbidden;  // its costs together forbid every value
    allowed_offsets.push_back(allowed.size());
  }
  return true;
}

bool CostTables::State::read_pairs(Deadline& deadline) {
  for (Index c = 0; c < problem.constraints.size(); ++c) {
    const std::vector<Index>& scope = problem.constraints[c].scope;
    if (scope.size() != 2) continue;
    if (deadline.reached()) return false;
    pairs[scope[0]].push_back(see_pair(c, false));
    pairs[scope[1]].push_back(see_pair(c, true));
  }
  return true;
}

// Copies only what the problem's own table cannot serve for.
CostTables::State::Pair CostTables::State::see_pair(Index constraint, bool second) {
  const std::vector<double>& costs = problem.constraints[constraint].costs;
  const std::vector<Index>& scope = problem.constraints[constraint].scope;
  const Index own = scope[second ? 1 : 0], other = scope[second ? 0 : 1];
  const std::size_t rows = problem.variables[own].domain(), columns = problem.variables[other].domain();
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

bool CostTables::State::list_conflicts(Deadline& deadline) {
  conflict_offsets.assign(1, 0);
  for (Index a = 0; a < problem.candidate_count; ++a) {
    if ((a & 63U) == 0 && deadline.reached()) return false;
    for (std::size_t word = 0; word < problem.conflict_words(); ++word)
      for (std::uint64_t bits = problem.conflict_bits[a * problem.conflict_words() + word]; bits != 0; bits &= bits - 1)
        conflicts.push_back(static_cast<Index>(word * 64 + static_cast<std::size_t>(__builtin_ctzll(bits))));
    conflict_offsets.push_back(conflicts.size());
  }
  return true;
}

}  // namespace toposcope
