// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Labelling problems with known answers: random ones small enough to list, and the queens.

#include <cstdint>
#include <vector>

#include "toposcope/labeling/make_problem.h"

namespace toposcope::test {

struct RandomKind {
  int variables = 4, domain = 4, arity = 3, constraints = 5;
  bool ties = false;               ///< costs and violations in quarters
  double optional = 1;             ///< part of the variables that may be missing
  double forbidden_unary = 0.06;   ///< part of the values
  double forbidden_entries = 0.1;  ///< part of the tables' entries
};

/// Scopes of 1 to `arity` variables; candidates shared and in conflict; entries with a missing variable cost nothing;
/// forbidden entries are violated, some that are not forbidden too.
LabelingProblem random_problem(const RandomKind& kind, std::uint64_t seed);

/// The kinds over which labelers are held against brute force, drawn by the seed itself.
RandomKind random_kind(std::uint64_t seed);

/// Every labelling of finite cost, best first, ties by the values. Exponential.
std::vector<Labeling> all_labelings(const LabelingProblem& problem);

struct BruteForce {
  double log_evidence = 0;                      ///< -infinity where there is no labelling
  std::vector<std::vector<double>> posteriors;  ///< per variable, per value
};
BruteForce sums(const LabelingProblem& problem, const std::vector<Labeling>& all);

/// n queens: a variable per row, none optional, a hard constraint per pair of rows. 92, 724 and 14,200 solutions for 8,
/// 10 and 12.
LabelingProblem queens(Index n);

}  // namespace toposcope::test
