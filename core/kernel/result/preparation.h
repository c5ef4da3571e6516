// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/repair.h"
#include "pipeline/stations.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// What a mesh is like. Lengths in the mesh's own unit.
struct MeshSummary {
  Index vertices = 0, faces = 0;
  Index components = 0, closed_components = 0, holes = 0, border_edges = 0;
  long euler = 0, genus = 0;
  double mean_edge = 0;
  double edge_variation = 0;  ///< standard deviation of the edge lengths over their mean
  Box box;
};

/// \param topology  of this mesh, from its repair
MeshSummary summary_of(const MeshView& mesh, const RepairReport& topology);

/// What `toposcope prepare` found in a mesh, and what it made of it.
struct Preparation {
  std::string mesh_path;
  Index file_vertices = 0, file_faces = 0;  ///< as read; faces may be polygons
  RepairReport repair;
  MeshSummary repaired;
  std::vector<PluginUse> filters;
  std::optional<MeshSummary> prepared;  ///< after the filters, if there are any
  std::string written;                  ///< the file; empty when none was asked for
};

std::string to_text(const Preparation& preparation);
std::string to_json_line(const Preparation& preparation);

}  // namespace toposcope
