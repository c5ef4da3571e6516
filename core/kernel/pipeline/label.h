// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pipeline/classes.h"
#include "pipeline/constructed_features.h"
#include "pipeline/model_run.h"

namespace toposcope {

/// The station *label* for one class: its labellings and, where the pipeline says so, its probabilities by another
/// labeler. Where features of the model can change their names each is then kept to its own side, nearer to its label
/// than to those of the others, and the class is solved again.
/// \param posed  of pose_classes
/// \throw PluginError
ClassOutcome label_class(ClassOutcome posed, const ConstructedFeatures& features, const ModelRun& run,
                         const LabelingRequest& request);

/// Says whether its answer has every feature, and every relationship within tolerance.
void complete_class(ClassOutcome& solved);

/// The constructed feature of each model feature in the labelling of least cost over the classes; nothing: missing.
/// \throw PluginError
std::vector<std::optional<Index>> first_labeling(const LabelingProblem& problem, const ModelRun& run);

}  // namespace toposcope
