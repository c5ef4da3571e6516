// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// `count` unit vectors spread evenly over the sphere (a spherical Fibonacci lattice).
std::vector<Vec3> spread_directions(std::size_t count);

}  // namespace toposcope
