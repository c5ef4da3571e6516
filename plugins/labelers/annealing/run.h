// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One run of simulated annealing: from a random labelling, through falling temperatures, to a local optimum.

#include <cstdint>
#include <vector>

#include "schedule.h"

namespace toposcope::annealing {

struct RunSettings {
  std::uint64_t sweeps, seed;
};

struct RunResult {
  std::vector<Labeling> labelings;  ///< the best met, as many and as costly as the request allows
  std::uint64_t moves = 0;
  bool stopped = false;  ///< by the deadline
};

RunResult run(const RunSettings& settings, const CostTables& tables, const Schedule& schedule,
              const LabelingRequest& request, Deadline deadline);

}  // namespace toposcope::annealing
