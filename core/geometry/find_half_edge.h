// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "toposcope/geometry/half_edges.h"

namespace toposcope::geometry {

/// A half-edge from a to b, `no_index` if there is none; and how many there are.
struct FoundHalfEdge {
  Index half_edge = no_index;
  int count = 0;
};
inline FoundHalfEdge find_half_edge(const MeshView& mesh, Index a, Index b) {
  FoundHalfEdge found;
  for (Index f : mesh.faces_of(a))
    for (Index k = 0; k < 3; ++k)
      if (mesh.triangles[f][k] == a && mesh.triangles[f][(k + 1) % 3] == b) found = {3 * f + k, found.count + 1};
  return found;
}

}  // namespace toposcope::geometry
