// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// The undirected edges of triangles, of which a few come and go: a sorted row, and what differs from it. Asking does
/// not depend on the degrees of the ends, as walking around them would.
class EdgeSet {
 public:
  explicit EdgeSet(std::span<const Triangle> triangles);

  bool contains(Index a, Index b) const;
  void insert(Index a, Index b) { changed_[key(a, b)] = true; }
  void erase(Index a, Index b) { changed_[key(a, b)] = false; }

 private:
  static std::uint64_t key(Index a, Index b);

  std::vector<std::uint64_t> sorted_;
  std::unordered_map<std::uint64_t, bool> changed_;
};

}  // namespace toposcope
