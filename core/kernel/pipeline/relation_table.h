// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/bound_relation.h"
#include "pipeline/constructed_features.h"
#include "toposcope/labeling.h"

namespace toposcope {

/// A relationship as a constraint: its tables over all combinations of its features' candidates.
/// \param problem  has the variables and their conflicts
/// \throw UsageError  the table would be too large; PluginError  the relation threw
LabelingConstraint relation_table(const BoundRelation& relation, const LabelingProblem& problem,
                                  const ConstructedFeatures& features);

}  // namespace toposcope
