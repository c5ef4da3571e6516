// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "sample/plane_path.h"

namespace toposcope {

/// Triangles of a plane region, as programs for CAD cut their faces: a bridge to each hole (Eberly 2002, Triangulation
/// by ear clipping), then ears (Meisters 1975), decided without rounding on a grid of 2^-28 of their reach. Every
/// corner is used, none is added, and all triangles turn left. \param points  of all loops \param outer   corners of
/// the outer loop, counter-clockwise, into `points` \param holes   corners of loops within it that do not touch it or
/// each other, clockwise \pre the loops are simple \throw std::logic_error  where loops meet
std::vector<Triangle> triangulate(std::span<const Vec2> points, const std::vector<Index>& outer,
                                  const std::vector<std::vector<Index>>& holes);

}  // namespace toposcope
