// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/fans.h"

#include <algorithm>
#include <numeric>

#include "toposcope/geometry/large_array.h"

namespace toposcope {

Fans separate_fans(std::size_t vertices, std::span<const Triangle> original, const Gluing& gluing) {
  Fans fans;
  fans.vertex = large_array<Index>(3 * original.size(), Gluing::none);
  fans.source = large_array<Index>(vertices);
  std::iota(fans.source.begin(), fans.source.end(), 0);
  std::vector<bool> taken(vertices, false);
  const auto corner = [&](Index side) { return original[side / 3][side % 3]; };
  std::vector<Index> fan;
  for (Index first = 0; first < fans.vertex.size(); ++first) {
    if (fans.vertex[first] != Gluing::none) continue;
    // Back to the border, if there is one, then forward.
    Index begin = first;
    while (gluing.opposite[begin] != Gluing::none) {
      begin = Gluing::next(gluing.opposite[begin]);
      if (begin == first) break;
    }
    fan.clear();
    for (Index side = begin;;) {
      fan.push_back(side);
      side = next_around(gluing, side);
      if (side == Gluing::none || side == begin) break;
    }
    Index vertex = Gluing::none;
    for (Index side : fan)
      if (!taken[corner(side)]) vertex = std::min(vertex, corner(side));
    if (vertex == Gluing::none) {
      vertex = static_cast<Index>(fans.source.size());
      fans.source.push_back(corner(first));
    } else {
      taken[vertex] = true;
    }
    for (Index side : fan) fans.vertex[side] = vertex;
  }
  return fans;
}

}  // namespace toposcope
