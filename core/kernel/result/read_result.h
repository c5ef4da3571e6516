// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toposcope/shapes.h"

namespace toposcope {

/// A feature as result.json tells of it.
struct StoredFeature {
  std::string name;
  bool present = false;
  double probability = 0;  ///< not a number where there is none
  std::string shape;
  std::vector<ShapeParameter> parameters;
  std::vector<Index> faces;  ///< of the input file
};

/// A result.json that was read back, as far as pictures and exports need it.
struct StoredResult {
  std::string text;  ///< the document
  std::filesystem::path mesh;
  std::string mesh_hash;  ///< content_hash of the mesh that it speaks of
  std::string model;
  std::vector<StoredFeature> features;
};

/// \throw UsageError  names the file and what is wrong with it
StoredResult read_result(const std::filesystem::path& file);

}  // namespace toposcope
