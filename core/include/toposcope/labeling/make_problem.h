// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Problems made by hand, as readers and tests make them.

#include <utility>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope {

/// A constraint whose every entry costs nothing and is satisfied. Its name is empty.
/// \param scope  variables of the problem, each once
inline LabelingConstraint empty_constraint(const LabelingProblem& problem, std::vector<Index> scope) {
  LabelingConstraint constraint{.name = "", .scope = std::move(scope)};
  std::size_t entries = 1;
  for (const Index v : constraint.scope) entries *= problem.variables[v].domain();
  constraint.costs.assign(entries, 0);
  constraint.violations.assign(entries, 0);
  return constraint;
}

/// Two candidates exclude each other; the first time makes room in the table.
/// \pre `candidate_count` is above both
inline void set_conflict(LabelingProblem& problem, Index a, Index b) {
  problem.conflict_bits.resize(problem.candidate_count * problem.conflict_words());
  problem.conflict_bits[a * problem.conflict_words() + b / 64] |= std::uint64_t{1} << (b % 64);
  problem.conflict_bits[b * problem.conflict_words() + a / 64] |= std::uint64_t{1} << (a % 64);
}

}  // namespace toposcope
