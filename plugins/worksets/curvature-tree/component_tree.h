// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "toposcope/mesh_view.h"

namespace component_tree {

using toposcope::Index;

struct Limits {
  double growth;  ///< a component is offered again each time that it has grown by this factor
  Index min_vertices;
  Index max_vertices;
  std::size_t max_components;  ///< those of greatest saliency times root of size are kept
};

struct Component {
  std::vector<Index> vertices;
  /// 1 - exp(-(fall of the field until the component has grown by the growth factor or merged)): near 1 for a
  /// component with a steep border, near 0 for a passing stage.
  double saliency = 0;
};

/// Components of {field >= t} over all t: those just before two merge, and between merges one for each growth by the
/// factor. The field is read in steps of 0.02 (the fields are logarithms), so that vertices that differ by rounding
/// alone enter together. Time: sorting the field, plus the total size of what is returned. Sorted by
/// saliency times the root of the size, descending.
std::vector<Component> components(const toposcope::MeshView& mesh, const std::vector<double>& field,
                                  const Limits& limits);

}  // namespace component_tree
