// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "toposcope/conditional_costs.h"

namespace toposcope {

CostTables::CostTables(const LabelingProblem& problem, Deadline& deadline) : problem_(problem) {
  read_variables();
  complete_ = read_constraints(deadline) && turn_pairs(deadline) && list_conflicts(deadline);
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
    double least = forbidden, largest = 0;
    bool forbids = false;
    for (const double cost : costs) {
      least = std::min(least, cost);
      forbids |= cost == forbidden;
      largest = std::max(largest, cost < forbidden ? std::abs(cost) : 0);
    }
    bound += least;
    magnitude += largest;
    return forbids;
  };
  for (const LabelingVariable& variable : problem_.variables) read(variable.costs);
  for (Index c = 0; c < problem_.constraints.size(); ++c) {
    if (deadline.reached()) return false;
    const LabelingConstraint& constraint = problem_.constraints[c];
    forbids_.push_back(read(constraint.costs));
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

bool CostTables::turn_pairs(Deadline& deadline) {
  for (std::size_t c = 0; c < problem_.constraints.size(); ++c) {
    const LabelingConstraint& constraint = problem_.constraints[c];
    if (constraint.scope.size() != 2) continue;
    if (deadline.reached()) return false;
    const Index first = constraint.scope[0], second = constraint.scope[1];
    const std::size_t rows = problem_.variables[first].domain(), columns = problem_.variables[second].domain();
    turned_.push_back(std::make_unique_for_overwrite<double[]>(rows * columns));
    double* turned = turned_.back().get();
    for (std::size_t a = 0; a < rows; ++a)
      for (std::size_t b = 0; b < columns; ++b) turned[b * rows + a] = constraint.costs[a * columns + b];
    pairs_[first].push_back({constraint.costs.data(), second, forbids_[c]});
    pairs_[second].push_back({turned, first, forbids_[c]});
  }
  return true;
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
