// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/weld.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "mesh/position_hash.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
std::vector<Index> first_at_same_place(std::span<const Vec3> points, const std::vector<bool>& among) {
  constexpr Index empty = std::numeric_limits<Index>::max();
  const auto asked = static_cast<std::size_t>(std::count(among.begin(), among.end(), true));
  const std::size_t size = std::bit_ceil(2 * asked + 1);
  std::vector<Index> slots = large_array<Index>(size, empty);
  std::vector<Index> first = large_array<Index>(points.size());
  for (Index v = 0; v < points.size(); ++v) {
    first[v] = v;
    if (!among[v] || !points[v].allFinite()) continue;
    std::size_t i = position_hash(points[v]) & (size - 1);
    while (slots[i] != empty && points[slots[i]] != points[v]) i = (i + 1) & (size - 1);
    if (slots[i] == empty)
      slots[i] = v;
    else
      first[v] = slots[i];
  }
  return first;
}

}  // namespace toposcope
