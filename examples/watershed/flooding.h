// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "toposcope/mesh_view.h"

namespace watershed {

using toposcope::Index;

struct Basins {
  std::vector<Index> of_vertex;  ///< basin of each vertex, from 0; `toposcope::Index(-1)` where it has no face
  std::vector<double> lowest;    ///< height at each basin's bottom
  std::vector<double> area;
};

/// Catchment basins of a height per vertex: the surface is flooded from below, and where two pools meet that are both
/// deeper than `depth` a divide is kept; a shallower pool runs into the other. Then basins of less area than
/// `least_area` are joined to the neighbour over the lowest pass.
Basins flood(const toposcope::MeshView& mesh, const std::vector<double>& height, double depth, double least_area);

}  // namespace watershed
