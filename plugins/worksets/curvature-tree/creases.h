// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "component_tree.h"

namespace creases {

/// What a tessellation itself says: parts of its surface between sharp edges, and the sharp edges. Sets share the
/// vertices of the edges between them; so parts also come without these.
struct Parts {
  component_tree::Components convex, concave, planar;
  /// Per vertex: made by a filter, inside of a flat part. There is no curvature there, whatever a neighbourhood or a
  /// mean over rings brings along from an edge of the part.
  std::vector<bool> flat;
};

/// Linear time. \param min_vertices  the least size of a set
Parts parts_of(const toposcope::MeshView& mesh, const component_tree::Limits& limits);

}  // namespace creases
