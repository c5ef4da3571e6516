// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/analysis.h"

namespace toposcope {

/// Posterior of a value with that of all values whose shape is the same to within a mean edge: of one place. Nested
/// working sets give a feature many candidates in one place. *Missing* is a place of its own.
/// \pre there are posteriors
double probability_of_place(const ClassOutcome& posed, Index variable, Index value, const Model& model,
                            const Analysis& analysis, const Stations& stations);

/// The labelling that is reported. Candidates in one place share its probability, so that one that stands alone may
/// make the labelling of least cost though it is in a place of little probability. Where another place of a feature
/// has more than that of the label of least cost, the labels are those of least cost with such features in their most
/// probable places; everywhere else, and without posteriors, the labelling of least cost.
Labeling in_most_probable_places(const ClassOutcome& posed, const Model& model, const Analysis& analysis,
                                 const Stations& stations, Context& context);

}  // namespace toposcope
