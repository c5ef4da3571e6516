// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "toposcope/labeling/tools.h"

namespace toposcope {

/// Smallest set of items, of fewer than `limit`, that has one of every set; branch and bound over the set with the
/// fewest items. The first found in that order, so that it is the same on every run. \return false where there is none,
/// or the deadline was reached
bool smallest_hitting_set(const std::vector<std::vector<std::size_t>>& sets, std::size_t items, std::size_t limit,
                          Deadline& deadline, std::vector<std::size_t>& found);

}  // namespace toposcope
