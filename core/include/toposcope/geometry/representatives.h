// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// At most `limit` points, evenly spread over the ranking by distance from `center`: the choice depends neither on the
/// pose nor on the order of the points, as long as `center` turns and moves with them. For fits that need not see all.
std::vector<Vec3> representatives(std::span<const Vec3> points, const Vec3& center, std::size_t limit);

}  // namespace toposcope
