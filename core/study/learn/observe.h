// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "pipeline/stations.h"
#include "truth/truth.h"

namespace toposcope {

/// What a marked mesh says of a feature.
struct SeenFeature {
  bool marked = false;   ///< the truth tells of it, there or not there
  bool exists = false;   ///< marked, with points
  bool offered = false;  ///< the model has a right candidate
  /// Of the right candidate, or, where there is none, of the shape fitted to the marks: in units of the sides of bb(O),
  /// one value for each of a, b, c; numbers and angles as they are.
  std::map<std::string, std::vector<double>> measures;
  std::vector<std::string> broken;  ///< bounds of the model that the marked shape breaks, with value and limit
};

/// What a marked mesh says of a relationship between features that are offered.
struct SeenRelation {
  bool tested = false, applicable = false, satisfied = false;
  double residual = 0, tolerance = 0;  ///< degrees, or parts of bb(O).a
  std::string unit;
};

struct Observation {
  std::string source;                   ///< name of the truth file
  std::vector<SeenFeature> features;    ///< of the model
  std::vector<SeenRelation> relations;  ///< of the model
};

/// \throw UsageError  the truth tells of no feature of the model
Observation observe(const Mesh& mesh, const Truth& truth, const std::string& source, const Model& model,
                    const Stations& stations, Context& context);

}  // namespace toposcope
