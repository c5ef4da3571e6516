// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toposcope/mesh_view.h"

namespace component_tree {

using toposcope::Index;

/// A field read in steps: vertices that differ by rounding alone enter a component together.
using Levels = std::vector<std::int32_t>;

struct Limits {
  double growth;  ///< a component is offered again each time that it has grown by this factor
  Index min_vertices;
  Index max_vertices;
  std::size_t max_components;  ///< those of greatest saliency times root of size are kept
};

/// In compressed rows: the vertices of component i are [offsets[i], offsets[i + 1]), ascending.
struct Components {
  std::vector<std::size_t> offsets = {0};
  std::vector<Index> vertices;
  /// 1 - exp(-(fall of the field until the component has grown by the growth factor or merged)): near 1 for a
  /// component with a steep border, near 0 for a passing stage.
  std::vector<double> saliency;

  std::size_t size() const { return saliency.size(); }
  std::span<const Index> operator[](std::size_t i) const {
    return std::span(vertices).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
};

/// Components of {level >= t} over all t: those just before two merge, and between merges one for each growth by the
/// factor. Time: that of sorting the levels by counting, a union-find over the edges, and the total size of what is
/// returned. Sorted by saliency times the root of the size, descending.
/// \param step  of the field per level
Components components(const toposcope::MeshView& mesh, const Levels& level, double step, const Limits& limits);

}  // namespace component_tree
