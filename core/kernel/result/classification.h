// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "result/result.h"

namespace toposcope {

/// Which class of objects explains a mesh best: over the classes of all models, a model without classes being one.
struct Classification {
  std::string mesh_path;
  std::string class_name;                                     ///< empty when nothing fits
  std::string model;                                          ///< of the class
  std::vector<std::pair<std::string, double>> probabilities;  ///< all classes alike beforehand; last "none"
  std::vector<RelationReport> relations;                      ///< of the best class
};

/// \param results  the same mesh explained by each model
Classification classify(const std::vector<Result>& results);

/// One object on one line.
std::string to_json_line(const Classification& classification);

/// In the manner of Table 6.3: the mesh, a bullet for each relationship that is satisfied, the class.
std::string to_text(const Classification& classification);

}  // namespace toposcope
