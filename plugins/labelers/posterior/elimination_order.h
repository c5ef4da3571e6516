// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// In which order to eliminate variables, and how large the tables then are.

#include <limits>
#include <vector>

#include "factors.h"

namespace toposcope::posterior {

struct EliminationPlan {
  std::vector<Index> order;                   ///< variables, first eliminated first
  std::vector<std::vector<Index>> neighbors;  ///< per variable: those that its elimination binds, ascending
  double entries = std::numeric_limits<double>::infinity();  ///< of all tables together
};

/// The best of several greedy orders: least fill, least weighted fill, least table, and repetitions in which ties are
/// drawn. Entries are infinite where no order is below `limit`.
/// \throw OutOfTime
EliminationPlan elimination_plan(const FactorGraph& graph, double limit, Watch& watch);

}  // namespace toposcope::posterior
