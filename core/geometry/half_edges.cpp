// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/half_edges.h"

#include <stdexcept>

#include "find_half_edge.h"

namespace toposcope {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument(what + "; the mesh must be an oriented manifold: repair it first (toposcope prepare)");
}

std::string edge_text(Index a, Index b) {
  return "the edge between vertices " + std::to_string(a) + " and " + std::to_string(b) + " (from 0)";
}

// Turning about a vertex from one of its faces must reach them all.
void check_fan(const MeshView& mesh, const std::vector<Index>& opposite, Index v) {
  const std::span<const Index> faces = mesh.faces_of(v);
  if (faces.empty()) return;
  const Triangle& t = mesh.triangles[faces[0]];
  const Index first = 3 * faces[0] + (t[0] == v ? 0 : (t[1] == v ? 1 : 2));
  Index start = first;
  while (opposite[start] != no_index) {
    start = next_half_edge(opposite[start]);
    if (start == first) break;
  }
  std::size_t reached = 0;
  for (Index h = start; h != no_index; h = opposite[previous_half_edge(h)]) {
    if (h == start && reached > 0) break;
    ++reached;
  }
  if (reached != faces.size()) refuse("the faces around vertex " + std::to_string(v) + " (from 0) are not one fan");
}

}  // namespace

std::vector<Index> opposite_half_edges(const MeshView& mesh) {
  std::vector<Index> opposite(3 * mesh.triangles.size(), no_index);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[f][k], b = mesh.triangles[f][(k + 1) % 3];
      const geometry::FoundHalfEdge same = geometry::find_half_edge(mesh, a, b),
                                    other = geometry::find_half_edge(mesh, b, a);
      if (same.count + other.count > 2) refuse(edge_text(a, b) + " has more than two faces");
      if (same.count > 1) refuse(edge_text(a, b) + " has two faces of opposite orientation");
      opposite[3 * f + k] = other.half_edge;
    }
  for (Index v = 0; v < mesh.vertex_count(); ++v) check_fan(mesh, opposite, v);
  return opposite;
}

}  // namespace toposcope
