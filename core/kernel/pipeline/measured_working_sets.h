// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/model.h"
#include "pipeline/bit_matrix.h"
#include "pipeline/working_sets.h"

namespace toposcope {

/// Working sets with what the stations after *classify* ask of them again and again.
struct MeasuredWorkingSets : WorkingSets {
  MeasuredWorkingSets() = default;
  /// \param asked  types of which boxes are needed: add_asked_types
  MeasuredWorkingSets(WorkingSets sets, const std::vector<std::string>& asked, const MeshView& mesh, Context& context);

  BitMatrix overlap;                              ///< the sets that share a vertex; every set shares with itself
  std::vector<Box> boxes;                         ///< per set; of those alone whose type is asked for
  std::vector<double> edges;                      ///< per set: mean length of the edges within it, mesh unit; 0: none
  std::vector<double> vertex_areas;               ///< per vertex a third of the triangles around it, squared mesh unit
  std::vector<double> integrated_mean_curvature;  ///< per vertex: mean_curvature_measure, mesh unit
};

/// Adds the types of working sets that a model's features ask for and the list does not have.
void add_asked_types(const Model& model, std::vector<std::string>& types);

}  // namespace toposcope
