// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/mesh.h"

namespace toposcope {

/// Whether the corners of a triangle lie on a line, to rounding.
bool is_flat(const std::vector<Vec3>& positions, const Triangle& triangle);

struct FlatFaces {
  Index removed = 0;  ///< flipped with the neighbour at their longest side, or dropped at the border
  Index kept = 0;     ///< neither could be done without changing the surface
};

/// Removes faces whose three corners lie on a line, without opening the surface.
/// \param soup  a consistently oriented manifold with border; stays one
FlatFaces remove_flat_faces(TriangleSoup& soup);

}  // namespace toposcope
