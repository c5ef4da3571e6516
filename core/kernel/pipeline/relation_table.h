// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "pipeline/bound_relation.h"
#include "pipeline/constructed_features.h"
#include "toposcope/labeling.h"

namespace toposcope {

/// Entries of a relationship's table: all combinations of its features' values.
/// \throw UsageError  too many
std::size_t table_size(const Relationship& relationship, const LabelingProblem& problem);

/// A relationship as a constraint, its tables filled.
/// \param problem  has the variables and their conflicts
/// \throw UsageError  the table would be too large; PluginError  the relation threw
LabelingConstraint relation_table(const BoundRelation& relation, const LabelingProblem& problem,
                                  const ConstructedFeatures& features);

}  // namespace toposcope
