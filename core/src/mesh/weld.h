// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// For each point the first one at exactly the same place (-0 is 0). A point that is not finite is alone.
std::vector<Index> first_at_same_place(std::span<const Vec3> points);

}  // namespace toposcope
