// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope {

/// A labelling problem as a file holds it.
struct ProblemFile {
  LabelingProblem problem;
  double top = std::numeric_limits<double>::infinity();  ///< a labelling that costs so much or more is no solution
  bool maximize = false;                   ///< .cfn asks for the greatest value: costs are minus its values
  std::vector<std::string> warnings = {};  ///< where the file contradicts itself and was read all the same
};

}  // namespace toposcope
