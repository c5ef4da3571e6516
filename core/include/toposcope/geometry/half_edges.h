// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "toposcope/mesh_view.h"

namespace toposcope {

/// No vertex, face or half-edge.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

/// Half-edge 3 f + k runs from corner k of face f to the next corner; it lies in face h / 3.
constexpr Index next_half_edge(Index h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
constexpr Index previous_half_edge(Index h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

/// For each half-edge the opposite one, `no_index` on the boundary.
/// \throw std::invalid_argument where the mesh is not a consistently oriented manifold with boundary: an edge of more
///        than two faces, two faces that run along an edge in the same direction, a vertex whose faces make more than
///        one fan. The message names the place and the remedy.
std::vector<Index> opposite_half_edges(const MeshView& mesh);

}  // namespace toposcope
