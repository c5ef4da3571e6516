// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pipeline/classes.h"
#include "pipeline/constructed_features.h"
#include "pipeline/model_run.h"

namespace toposcope {

/// Which side is which: of features that could change names, those names under which the object's own directions are
/// right-handed. Nothing where nothing tells.
/// \param posed  with its renamings, of which those that keep the sides are left
/// \param places  a value for each variable, as `own_places` makes them; renamed where sides are told
std::optional<Sides> tell_sides(ClassOutcome& posed, std::vector<Index>& places, const ConstructedFeatures& features,
                                const ModelRun& run);

}  // namespace toposcope
