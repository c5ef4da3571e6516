// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mesh/adjacency.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// Positions and triangles as a file (or a filter) gives them, before they are checked.
struct TriangleSoup {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  /// For each triangle the face of the input that it came from: a polygon makes several triangles.
  std::vector<Index> face_origin;
  Index input_faces = 0;  ///< number of faces in the input, `face_origin` is below it
  /// For each position the vertex of the mesh that was read, or `no_vertex`; empty: all are, by number.
  std::vector<Index> input_vertices = {};
};

/// A checked mesh with adjacency. Immutable.
class Mesh {
 public:
  /// \param name     for messages: the file's name
  /// \param context  null: in the calling thread alone; the mesh is the same
  /// \throw MeshError  no vertex, no face, a position that is not finite, an index out of range, all faces
  ///        degenerate, no extent. Faces that repeat a vertex are dropped.
  Mesh(TriangleSoup soup, const std::string& name, Context* context = nullptr);

  const MeshView& view() const { return view_; }
  std::span<const Index> face_origin() const { return soup_.face_origin; }
  Index input_faces() const { return soup_.input_faces; }

  Mesh(Mesh&&) noexcept = default;
  Mesh& operator=(Mesh&&) noexcept = default;

 private:
  TriangleSoup soup_;
  Rows faces_, neighbors_;
  MeshView view_;  ///< spans into the vectors above, whose buffers survive a move
};

}  // namespace toposcope
