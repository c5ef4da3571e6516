// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/classes.h"
#include "pipeline/constructed_features.h"
#include "pipeline/model_run.h"

namespace toposcope {

/// Posterior of a value with that of all values whose shape is the same to within a mean edge. Nested working sets give
/// a feature many candidates of one shape. *Missing* stands for itself.
/// \pre there are posteriors
double probability_of_shape(const ClassOutcome& posed, Index variable, Index value, const ConstructedFeatures& features,
                            const ModelRun& run);

/// Greatest such probability of a value other than *missing*; 0 where there is none.
/// \pre there are posteriors
double most_of_a_shape(const ClassOutcome& posed, Index variable, const ConstructedFeatures& features,
                       const ModelRun& run);

/// The labelling that is reported. Candidates of one shape share its probability, so that one that stands alone may
/// make the labelling of least cost though its shape has little probability. Where another shape of a feature
/// has more than that of the label of least cost, the labels are those of least cost with such features in their most
/// probable shapes; everywhere else, and without posteriors, the labelling of least cost.
/// \throw PluginError
Labeling with_most_probable_shapes(const ClassOutcome& posed, const ConstructedFeatures& features, const ModelRun& run);

}  // namespace toposcope
