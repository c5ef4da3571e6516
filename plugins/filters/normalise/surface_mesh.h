// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "toposcope/geometry/half_edges.h"

namespace toposcope::normalise {

/// How a vertex may move: anywhere on the surface, along a crease or the boundary, not at all.
enum class Kind : std::uint8_t { smooth, crease, corner };

/// A manifold with boundary that is edited in place: contiguous arrays over half-edges 3 f + k (half_edges.h). Edges on
/// a crease or the boundary carry the input half-edge that they stand for. Faces and vertices that were removed leave
/// gaps: a removed face's half-edges start at `no_index`, a removed vertex has the half-edge `no_index`.
class SurfaceMesh {
 public:
  std::vector<Vec3> position;
  std::vector<Kind> kind;
  std::vector<Index> anchor;    ///< for each vertex an input face at or near it
  std::vector<Index> outgoing;  ///< for each vertex a half-edge from it; on the boundary the one without opposite
  std::vector<Index> start;     ///< for each half-edge the vertex that it leaves
  std::vector<Index> opposite;  ///< `no_index` on the boundary
  std::vector<Index> curve;     ///< input half-edge of the crease (or boundary) under an edge, `no_index` on the others

  Index faces() const { return live_faces_; }
  Index face_slots() const { return static_cast<Index>(start.size() / 3); }
  bool is_face(Index f) const { return start[3 * f] != no_index; }
  bool is_half_edge(Index h) const { return start[h] != no_index; }
  Index end(Index h) const { return start[next_half_edge(h)]; }
  Index apex(Index h) const { return start[previous_half_edge(h)]; }
  /// Each edge once: of its half-edges the lesser.
  bool stands_for_edge(Index h) const { return is_half_edge(h) && h < opposite[h]; }
  double length(Index h) const { return (position[start[h]] - position[end(h)]).norm(); }
  Vec3 area_normal(Index f) const;
  double area() const;

  /// Calls visit(h) for each half-edge that leaves v, counter-clockwise.
  template <class Visit>
  void around(Index v, Visit visit) const {
    const Index first = outgoing[v];
    if (first == no_index) return;
    Index h = first;
    do {
      visit(h);
      h = opposite[previous_half_edge(h)];
    } while (h != no_index && h != first);
  }
  /// Calls visit(w) for each neighbour of v.
  template <class Visit>
  void ring(Index v, Visit visit) const {
    around(v, [&](Index h) {
      visit(end(h));
      if (opposite[previous_half_edge(h)] == no_index) visit(apex(h));
    });
  }

  /// Takes over triangles whose opposite half-edges are known.
  void assign(const MeshView& mesh, const std::vector<Index>& opposites);

  /// Whether the start of h can be drawn into its end without changing the topology (link condition).
  bool can_collapse(Index h);
  /// Draws the start of h into its end, which keeps its position. \pre can_collapse(h)
  void collapse(Index h);
  /// Whether the edge may be replaced by the one between its faces' far corners: inner, not on a crease, the other
  /// absent.
  bool can_flip(Index h) const;
  void flip(Index h);
  /// Cuts the edge and its faces at its midpoint; returns the new vertex.
  Index split(Index h);

 private:
  Index new_face();
  void drop_face(Index f);
  void link(Index h, Index g);
  void settle(Index v, Index half_edge);

  Index live_faces_ = 0;
  std::vector<Index> free_faces_;
  std::vector<Index> mark_;  ///< of vertices: the number of the last query that met them
  Index query_ = 0;
};

}  // namespace toposcope::normalise
