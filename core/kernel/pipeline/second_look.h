// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "pipeline/constructed_features.h"
#include "pipeline/measured_working_sets.h"
#include "pipeline/model_run.h"

namespace toposcope {

/// Whether a feature of the model asks for a second look.
bool has_second_look(const Model& model);

/// The feedback from labelling that dissertation 7.2 wishes for: fits the groups that features name under
/// `second_look`, of working sets that share no vertex with what another feature is labelled with. Of these groups the
/// labelling tells which are worth a fit: those whose boxes, as stand-ins for the shapes, come near to holding the
/// relationships with the features that are labelled, and of these the most salient.
/// \param labelled  per model feature, into ConstructedFeatures::all; nothing: missing
/// \return whether there are candidates that were not there before
bool look_again(const ModelRun& run, const MeasuredWorkingSets& sets, std::span<const std::optional<Index>> labelled,
                ConstructedFeatures& features);

}  // namespace toposcope
