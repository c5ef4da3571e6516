// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// How triangles hang together along their sides. Side 3 f + k runs from corner k of face f to the next corner.
struct Gluing {
  static constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> opposite;  ///< the side of another face that each is glued to, or none
  Index split_edges = 0;        ///< edges that more than two faces share

  static Index next(Index side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static Index last(Index side) { return side % 3 == 0 ? side + 2 : side - 1; }
};

/// Glues the faces at each edge in pairs. Two faces are glued whatever their orientation. Of more than two, those first
/// that alone share an edge of the original corners; then, around the edge, each face with the next one on the far side
/// of the material between them, as their orientations tell; what is left is border, or glued if it is two. \param
/// welded    corners, equal where vertices lie at one place; no triangle repeats one \param original  corners as the
/// file has them
Gluing glue(std::span<const Vec3> positions, std::span<const Triangle> welded, std::span<const Triangle> original);

}  // namespace toposcope
