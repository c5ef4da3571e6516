// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/constructed_features.h"
#include "pipeline/fit_groups.h"

namespace toposcope {

/// Adds the fitted groups to the candidates that each feature of the job has; those of greatest evidence stay. Of
/// groups that were chosen from many, those that were not tried would have passed as often as those that were. In a
/// second look groups whose sets overlap and whose shape is the same are one candidate.
/// \param features  has an entry in `of_feature` for each feature of the model
void choose_candidates(const FitJob& job, const GroupFits& fits, const ModelRun& run, const MeasuredWorkingSets& sets,
                       ConstructedFeatures& features);

}  // namespace toposcope
