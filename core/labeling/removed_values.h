// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Why values were removed, in words, read from the trail.

#include <vector>

#include "crisp_propagation.h"

namespace toposcope {

/// In the order in which they were removed: first what was never open, *missing* not counted, then the trail.
/// \pre nothing was decided: arc consistency alone
std::vector<RemovedValue> removed_values(const Propagation& domains);

}  // namespace toposcope
