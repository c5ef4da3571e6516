// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "toposcope/labeling/tools.h"

namespace toposcope {

/// How a greedy labelling is made.
struct GreedyRules {
  std::vector<Index> order;  ///< every variable, first to last
  std::vector<double> rank;  ///< per value of all variables in one row, lower first; empty: by what the value adds to
                             ///< the cost of the labelling so far
  std::size_t rounds = 8;    ///< searches at most; each begins with the variable at which most of the last ended
  std::size_t backtracks = 1000;  ///< of one search at most
};

/// A labelling of finite cost, exclusions met: each variable takes the first value by rank that no variable before it
/// excludes or forbids (constraints are asked once all their variables have values), *missing* where nothing else is
/// left; at a dead end it goes back. \return its values, or nothing where none was found within the rules
std::optional<std::vector<Index>> greedy_labeling(const LabelingProblem& problem, GreedyRules rules,
                                                  Deadline& deadline);

}  // namespace toposcope
