// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/bit_matrix.h"
#include "pipeline/constructed_features.h"
#include "pipeline/measured_working_sets.h"
#include "pipeline/model_run.h"

namespace toposcope {

/// Which constructed features may not stand beside each other, symmetric; each excludes itself.
///
/// Two of one dimension may not share a place: a vertex, or the curve or surface of which both are pieces (the outline
/// of each lies on the other within what their fits can tell apart; of two lines that are not both sharp edges, within
/// the spacing of the mesh beside them). Of two dimensions the lower may be the border of the higher: at least half of
/// its vertices are outside of it or have a neighbour there, and the two share no more than half of all their vertices.
/// Else they may not share a vertex.
BitMatrix exclusions(const ModelRun& run, const MeasuredWorkingSets& sets,
                     const std::vector<ConstructedFeature>& features);

}  // namespace toposcope
