// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Problems of small width (chains, trees, few cycles) without a search.

#include "toposcope/labeling.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::least_error {

struct Limits {
  std::size_t k_best;
  std::uint64_t memory_budget;  ///< bytes
  Deadline& deadline;
};

/// Fills `best` with the least-cost labellings of a problem whose elimination takes no longer than a few passes over
/// its tables, and says in `outcome` that they are proven. \return false where it does, or time ran out
bool by_elimination(const LabelingProblem& problem, const Limits& limits, BestLabelings& best,
                    LabelingOutcome& outcome);

}  // namespace toposcope::least_error
