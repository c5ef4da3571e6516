// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// One mesh to evaluate, from a file or to be made.
struct DatasetMesh {
  std::string name;     ///< in tables of single meshes
  std::string object;   ///< row of the tables: meshes of one object differ in their variant
  std::string variant;  ///< column of the tables: "5K"; empty for files

  std::filesystem::path file;   ///< empty: made
  std::filesystem::path truth;  ///< empty: none
  std::string class_name;       ///< empty: the truth's

  std::string kind, preset;
  std::map<std::string, double> parameters;
  bool random = false, scan = false, decimated = false;
  Index faces = 0, view = 0;
  std::optional<double> noise;
  std::uint64_t seed = 1;
};

/// Meshes whose truth is known and the model that labels them (schemas/dataset.schema.json).
struct Dataset {
  std::string name, summary, model;
  bool by_class = false;  ///< what counts as right: the class, not the features
  std::vector<DatasetMesh> meshes;
  std::vector<std::string> absent;  ///< patterns of optional entries that match no file
};

/// Patterns are matched and lists of face numbers and random draws spread out. \throw UsageError  `file:line:column`
/// of what is wrong
Dataset read_dataset(const std::filesystem::path& path);

}  // namespace toposcope
