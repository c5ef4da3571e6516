// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// Takes the mesh that a filter makes; copies what it is given. Set twice, the last one counts.
class MeshSink {
 public:
  virtual ~MeshSink() = default;
  /// \pre positions finite, indices of triangles below their number, at least one triangle of three different vertices
  /// \param face_origin    for each triangle, the face of the filter's input that it came from
  /// \param vertex_origin  for each vertex, the input's vertex that it is, at the same position to the last bit, or
  ///                       `no_vertex` where the filter made or moved it; empty: none is kept
  /// What is wrong is refused, with the filter's name, once `apply` has returned.
  virtual void set(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                   std::span<const Index> face_origin, std::span<const Index> vertex_origin) = 0;
};

/// Prepares a mesh. A filter that changes nothing need not call the sink.
class MeshFilter {
 public:
  virtual ~MeshFilter() = default;
  /// Cancelled, it sets what it has, which must be a whole mesh, or nothing.
  /// \throw std::exception  a mesh that it cannot work on; the run ends with its words
  virtual void apply(const MeshView& mesh, Context& context, MeshSink& sink) const = 0;
};

}  // namespace toposcope
