// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/model.h"

namespace toposcope {

/// Which features of a model cannot be told apart: for each feature the features (itself included, ascending) that some
/// renaming of features maps it to, where the renaming leaves the model as it is. An airplane's port and starboard
/// features are such pairs where no relationship names a direction.
std::vector<std::vector<Index>> interchangeable_features(const Model& model);

}  // namespace toposcope
