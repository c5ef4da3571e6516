// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "mesh/gluing.h"

namespace toposcope {

/// The next side that starts at the same vertex, through the face's last side; none at the border.
inline Index next_around(const Gluing& gluing, Index side) {
  return gluing.opposite[Gluing::last(side)];
}

struct Fans {
  std::vector<Index> vertex;  ///< of each corner 3 f + k
  std::vector<Index> source;  ///< of each vertex, the original one that it has the position of
};

/// Gives each fan of faces around a place a vertex of its own: the least original one of its corners that no other fan
/// has, or a new one at the end. So a clean mesh keeps its numbers.
/// \pre glued sides run in opposite directions
Fans separate_fans(std::size_t vertices, std::span<const Triangle> original, const Gluing& gluing);

}  // namespace toposcope
