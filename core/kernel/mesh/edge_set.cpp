// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edge_set.h"

#include <algorithm>

#include "toposcope/geometry/large_array.h"

namespace toposcope {

EdgeSet::EdgeSet(std::span<const Triangle> triangles) {
  reserve_large(sorted_, 3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    sorted_.push_back(key(a, b));
    sorted_.push_back(key(b, c));
    sorted_.push_back(key(c, a));
  }
  std::sort(sorted_.begin(), sorted_.end());
}

bool EdgeSet::contains(Index a, Index b) const {
  if (const auto change = changed_.find(key(a, b)); change != changed_.end()) return change->second;
  return std::binary_search(sorted_.begin(), sorted_.end(), key(a, b));
}

std::uint64_t EdgeSet::key(Index a, Index b) {
  const auto [low, high] = std::minmax(a, b);
  return (static_cast<std::uint64_t>(low) << 32) | high;
}

}  // namespace toposcope
