// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// For each point `among` those asked for the first of them at exactly the same place (-0 is 0); any other point, and
/// one that is not finite, stands for itself.
std::vector<Index> first_at_same_place(std::span<const Vec3> points, const std::vector<bool>& among);

}  // namespace toposcope
