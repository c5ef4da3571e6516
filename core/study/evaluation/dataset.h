// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sample/sample.h"
#include "sample/scan.h"

namespace toposcope {

/// A mesh to be read.
struct MeshFile {
  std::filesystem::path path;
  std::filesystem::path truth;  ///< empty: none
  std::string class_name;       ///< empty: the truth's
};

/// A mesh to be made: exact, or exact and decimated, or scanned.
struct MadeMesh {
  SampleRequest object = {};
  Index decimate_to = 0;                  ///< faces that the quadric error keeps of the exact mesh; 0: all
  std::optional<ScanSettings> scan = {};  ///< none: not scanned
};

/// One mesh to evaluate.
struct DatasetMesh {
  std::string name;     ///< in tables of single meshes
  std::string object;   ///< row of the tables: meshes of one object differ in their variant
  std::string variant;  ///< column of the tables: "5K"; empty for files
  std::variant<MeshFile, MadeMesh> source;
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
