// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/classes.h"
#include "pipeline/constructed_features.h"
#include "pipeline/model_run.h"
#include "result/result.h"

namespace toposcope {

/// A relationship of a posed class under a labelling of it, in the units of reports.
/// \throw PluginError
RelationReport report_relation(const ModelRun& run, const ClassOutcome& posed, const ConstructedFeatures& features,
                               Index constraint, const Labeling& labeling);

}  // namespace toposcope
