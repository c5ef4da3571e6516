// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// Takes the mesh that a filter makes; copies what it is given.
class MeshSink {
 public:
  virtual ~MeshSink() = default;
  /// \param origin  for each triangle, the face of the filter's input that it came from
  virtual void set(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                   std::span<const Index> origin) = 0;
};

/// Prepares a mesh. A filter that changes nothing need not call the sink.
class MeshFilter {
 public:
  virtual ~MeshFilter() = default;
  virtual void apply(const MeshView& mesh, Context& context, MeshSink& sink) const = 0;
};

}  // namespace toposcope
