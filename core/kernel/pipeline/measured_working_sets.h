// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/bit_matrix.h"
#include "pipeline/model_run.h"
#include "pipeline/working_sets.h"

namespace toposcope {

/// Working sets with what the stations after *classify* ask of them again and again.
struct MeasuredWorkingSets : WorkingSets {
  MeasuredWorkingSets() = default;
  /// \param sets  of the run's mesh
  MeasuredWorkingSets(WorkingSets sets, const ModelRun& run);

  BitMatrix overlap;                 ///< the sets that share a vertex; every set shares with itself
  std::vector<Box> boxes;            ///< per set; of those alone whose type a feature of the model asks for
  std::vector<double> edges;         ///< per set: mean length of the edges within it, mesh unit; 0: it has none
  std::vector<double> vertex_areas;  ///< per vertex a third of the triangles around it, squared mesh unit
  std::vector<double> integrated_mean_curvature;  ///< per vertex: mean_curvature_measure, mesh unit
};

}  // namespace toposcope
