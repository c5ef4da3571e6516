// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/model.h"

namespace toposcope {

/// Which features of a question cannot be told apart: for each the positions in `features` (its own included,
/// ascending) that some renaming maps it to, where the renaming leaves the question as it is. An airplane's port and
/// starboard features are such pairs where no relationship names a direction. \param features, relationships  of the
/// model, that the question is about \param ordered  per relationship of the model: it matters which feature comes
/// first \param by_detectability  detectability tells features apart (not in a class, whose features all belong to it)
std::vector<std::vector<Index>> interchangeable_features(const Model& model, const std::vector<Index>& features,
                                                         const std::vector<Index>& relationships,
                                                         const std::vector<bool>& ordered, bool by_detectability);

}  // namespace toposcope
