// SPDX-License-Identifier: BSD-3-Clause
#include "sample/well_composed.h"

#include <array>
#include <vector>

namespace toposcope {

namespace {

class Filler {
 public:
  explicit Filler(NodeGrid& grid) : grid_(grid), step_({1, grid.size[0], grid.size[0] * grid.size[1]}) {}

  void run() {
    for (std::size_t z = 0; z + 1 < grid_.size[2]; ++z)
      for (std::size_t y = 0; y + 1 < grid_.size[1]; ++y)
        for (std::size_t x = 0; x + 1 < grid_.size[0]; ++x) check(grid_.node(x, y, z));
    while (!changed_.empty()) {
      const std::size_t node = changed_.back();
      changed_.pop_back();
      for (std::size_t c = 0; c < 8; ++c)
        check(node - ((c & 1) != 0 ? step_[0] : 0) - ((c & 2) != 0 ? step_[1] : 0) - ((c & 4) != 0 ? step_[2] : 0));
    }
  }

 private:
  bool inside(std::size_t node) const { return grid_.values[node] < 0; }

  /// Looks at the cell of which `node` is the first corner.
  void check(std::size_t node) {
    unsigned mask = 0;
    for (unsigned c = 0; c < 8; ++c) mask |= static_cast<unsigned>(inside(corner(node, c))) << c;
    if (mask == 0 || mask == 255) return;
    for (unsigned axis = 0; axis < 3; ++axis)
      for (unsigned side = 0; side < 2; ++side) {
        const unsigned u = 1U << ((axis + 1) % 3), v = 1U << ((axis + 2) % 3), base = side << axis;
        const std::array<unsigned, 4> face = {base, base | u, base | u | v, base | v};
        const bool a = mask >> face[0] & 1, b = mask >> face[1] & 1, c = mask >> face[2] & 1, d = mask >> face[3] & 1;
        if (a == c && b == d && a != b) return fill(node, a ? face[1] : face[0], a ? face[3] : face[2]);
      }
    for (unsigned c = 0; c < 4; ++c) {
      const unsigned pair = 1U << c | 1U << (7 - c);
      if (mask == pair) return fill_largest_gap(node, pair);
      if ((mask ^ 255U) == pair) return fill(node, c, 7 - c);
    }
  }

  std::size_t corner(std::size_t node, unsigned c) const {
    return node + ((c & 1U) != 0 ? step_[0] : 0) + ((c & 2U) != 0 ? step_[1] : 0) + ((c & 4U) != 0 ? step_[2] : 0);
  }

  void fill(std::size_t node, unsigned c, unsigned d) {
    const std::size_t p = corner(node, c), q = corner(node, d);
    set_inside(grid_.values[q] < grid_.values[p] ? q : p);
  }

  /// Of the nodes outside the one nearest to the surface.
  void fill_largest_gap(std::size_t node, unsigned inside_mask) {
    std::size_t best = 0;
    float least = 1e30F;
    for (unsigned c = 0; c < 8; ++c) {
      const std::size_t p = corner(node, c);
      if ((inside_mask >> c & 1U) == 0 && grid_.values[p] < least) {
        least = grid_.values[p];
        best = p;
      }
    }
    set_inside(best);
  }

  void set_inside(std::size_t node) {
    grid_.values[node] = -0.05F * static_cast<float>(grid_.spacing);
    changed_.push_back(node);
  }

  NodeGrid& grid_;
  std::array<std::size_t, 3> step_;
  std::vector<std::size_t> changed_;
};

}  // namespace

void make_well_composed(NodeGrid& grid) {
  Filler(grid).run();
}

}  // namespace toposcope
