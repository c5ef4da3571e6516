// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>

#include "toposcope/types.h"

namespace toposcope {

inline constexpr Index no_vertex = std::numeric_limits<Index>::max();

/// A triangle mesh as plugins see it: contiguous arrays and adjacency in compressed rows, owned by the kernel.
/// Guaranteed: finite positions, indices in range, at least one face, no face with a repeated vertex. The program
/// repairs what it reads, so that its meshes are also manifold (with border) and consistently oriented; whoever needs
/// that of a mesh of other origin checks it (opposite_half_edges). Not guaranteed: closed, connected.
struct MeshView {
  std::span<const Vec3> positions;          ///< of the vertices, mesh unit
  std::span<const Triangle> triangles;      ///< of vertices, from 0
  std::span<const Index> neighbor_offsets;  ///< size vertices + 1, into `neighbors`
  std::span<const Index> neighbors;         ///< one-rings, ascending within a row
  std::span<const Index> face_offsets;      ///< size vertices + 1, into `faces`
  std::span<const Index> faces;             ///< faces around a vertex, ascending within a row
  Box box;                                  ///< bb(O)
  double mean_edge = 0;                     ///< mean length of the undirected edges, mesh unit
  /// For each vertex the vertex of the mesh that was read (and repaired) that it is, or `no_vertex` where a filter made
  /// or moved it: what lies between read vertices lies on a chord of what they sample. Empty: all are, by number.
  std::span<const Index> input_vertices = {};

  /// Number of vertices.
  Index vertex_count() const { return static_cast<Index>(positions.size()); }
  /// Number of triangles.
  Index face_count() const { return static_cast<Index>(triangles.size()); }
  /// The vertices that an edge joins to v, ascending.
  std::span<const Index> one_ring(Index v) const {
    return neighbors.subspan(neighbor_offsets[v], neighbor_offsets[v + 1] - neighbor_offsets[v]);
  }
  /// The faces around v, ascending.
  std::span<const Index> faces_of(Index v) const {
    return faces.subspan(face_offsets[v], face_offsets[v + 1] - face_offsets[v]);
  }
};

}  // namespace toposcope
