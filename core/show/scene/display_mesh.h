// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toposcope/mesh_view.h"

namespace toposcope {

/// More triangles than this are decimated to it before they are shown.
inline constexpr std::size_t shown_triangles_limit = 200000;

/// A mesh as it is shown: all of it, or with fewer triangles.
struct DisplayMesh {
  Index mesh_vertices = 0, mesh_triangles = 0;  ///< of the mesh that is shown
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> labels;  ///< one per shown triangle, or empty
  std::vector<Index> faces;          ///< per shown triangle the triangle of the mesh; empty: the same
  std::vector<Index> vertex_ids;     ///< per shown vertex the vertex of the mesh; empty: the same
  std::vector<Index> shown_as;       ///< per vertex of the mesh the shown vertex that stands for it; empty: itself

  /// Which shown vertices stand for these vertices of the mesh; ascending, each once.
  std::vector<Index> shown(std::span<const Index> vertices) const;
};

/// \param labels  one per triangle of the mesh, or empty; the line between two labels stays where it is
/// \param limit   triangles that may be shown; a mesh that cannot be decimated that far without tearing keeps more
DisplayMesh display_mesh(const MeshView& mesh, std::span<const std::uint8_t> labels,
                         std::size_t limit = shown_triangles_limit);

}  // namespace toposcope
