// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/constructed_features.h"
#include "pipeline/measured_working_sets.h"
#include "pipeline/model_run.h"
#include "toposcope/labeling.h"

namespace toposcope {

/// The station *relate*: the labelling problem of a mesh. Variable i is model feature i, constraint i relationship i.
/// \param known  of the same run, with fewer candidates: where those of a relationship's features are the same, so is
///               its table
/// \throw UsageError  a relationship's table, or all together, would be too large; PluginError  a relation threw
LabelingProblem relate(const ModelRun& run, const MeasuredWorkingSets& sets, const ConstructedFeatures& features,
                       const LabelingProblem* known = nullptr);

}  // namespace toposcope
