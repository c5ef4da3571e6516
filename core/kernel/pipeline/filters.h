// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "pipeline/stations.h"

namespace toposcope {

/// A mesh after the filters, and where its faces come from.
struct PreparedMesh {
  const Mesh* input = nullptr;
  /// Absent when no filter changed anything; its view's `input_vertices` are the input's.
  std::optional<Mesh> filtered;
  std::vector<Index> origin;  ///< per face of the filtered mesh, the triangle of the input
  const MeshView& view() const { return filtered ? filtered->view() : input->view(); }
};

/// Applies the filters one after the other. \param mesh  must outlive the result
/// \throw PluginError  a filter failed or does not say where its faces come from; MeshError  it left no usable mesh
PreparedMesh apply_filters(const Mesh& mesh, std::span<const FilterStation> filters, Context& context);

}  // namespace toposcope
