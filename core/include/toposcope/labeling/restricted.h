// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A labelling problem of fewer values.

#include <vector>

#include "toposcope/labeling.h"

namespace toposcope {

/// The problem with only the given values of each variable, numbered anew from 0 in their order: value i of a variable
/// is its value `kept[variable][i]` of before, at the same cost.
/// \param kept  per variable, ascending and not empty; of an optional variable 0, *missing*, is among them
/// \pre `check(problem)`
LabelingProblem restricted(const LabelingProblem& problem, const std::vector<std::vector<Index>>& kept);

}  // namespace toposcope
