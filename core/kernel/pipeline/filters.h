// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/coarsen.h"
#include "mesh/mesh.h"
#include "pipeline/stations.h"

namespace toposcope {

/// The mesh that is analysed, and where its faces come from.
struct PreparedMesh {
  const Mesh* input = nullptr;
  std::optional<CoarseMesh> coarse;  ///< in the place of an input that is finer than the pipeline looks
  /// Absent when no filter changed anything; its view's `input_vertices` are those of `base()`.
  std::optional<Mesh> filtered;
  std::vector<Index> origin;  ///< per face of `view()`, the triangle of `base()`

  /// What the filters get.
  const MeshView& base() const { return coarse ? coarse->mesh.view() : input->view(); }
  const MeshView& view() const { return filtered ? filtered->view() : base(); }

  /// Appends the vertices of the input that a vertex of `view()` stands for; none where a filter made it.
  void add_input_vertices(Index vertex, std::vector<Index>& vertices) const;
  /// The triangles of the input that the faces of `view()` stand for: those of which at least half (of the filtered
  /// pieces) are among these, or where there are none those of which any are; and of a coarse mesh those with two
  /// corners where half of the faces are. Ascending. \param which  one per face of `view()`
  std::vector<Index> input_triangles(const std::vector<bool>& which) const;
};

/// Applies the filters one after the other. \param mesh  must outlive the result
/// \throw PluginError  a filter failed or does not say where its faces come from; MeshError  it left no usable mesh
PreparedMesh apply_filters(const Mesh& mesh, std::span<const FilterStation> filters, Context& context);

/// The station *filter*: a coarse mesh where the pipeline wants one, and the filters.
/// \param mesh  must outlive the result
PreparedMesh prepare_mesh(const Mesh& mesh, const Stations& stations, Context& context);

}  // namespace toposcope
