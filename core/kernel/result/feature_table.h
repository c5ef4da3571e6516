// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "result/result.h"

namespace toposcope {

/// The features found on many meshes, a record for each.
class FeatureTable {
 public:
  void add(const Result& result);

  /// A row for each feature found: mesh, feature, shape, probability, fit error, centroid and direction (mesh unit and
  /// frame), then the measures of all shapes, each with its standard deviation; empty where a shape has none.
  std::string csv() const;

 private:
  struct Record {
    std::string mesh;
    FeatureReport report;
  };
  std::vector<Record> records_;
  std::vector<std::string> measures_;  ///< in the order in which they came
};

}  // namespace toposcope
