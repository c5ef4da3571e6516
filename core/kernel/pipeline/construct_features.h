// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/constructed_features.h"
#include "pipeline/measured_working_sets.h"
#include "pipeline/model_run.h"
#include "pipeline/working_set_groups.h"

namespace toposcope {

/// The station *fit*: fits every shape that the model asks for to every group of working sets that may meet its ranges,
/// in parallel, and keeps for each feature the candidates of greatest evidence.
ConstructedFeatures construct_features(const ModelRun& run, const MeasuredWorkingSets& sets);

/// Fits a feature's shape to more groups, of the types of its second look; the best of old and new candidates stay.
/// Of those whose sets overlap and whose shape is the same one stays and stands for them all.
void construct_more(const ModelRun& run, const MeasuredWorkingSets& sets, Index feature, WorkingSetGroups groups,
                    ConstructedFeatures& features);

}  // namespace toposcope
