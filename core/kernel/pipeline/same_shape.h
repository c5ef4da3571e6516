// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/constructed_features.h"

namespace toposcope {

/// Whether each of two shapes of one fitter lies within `limit` of the other, on the average over its outline, and
/// their outlines meet: of two feet of a table, or two bores of one axis, each is a shape of its own.
bool same_shape(const ShapeFitter& fitter, const FittedShape& a, const FittedShape& b, double limit);

/// Whether two constructed features are one shape of one fitter.
bool same_shape(const ConstructedFeature& a, const ConstructedFeature& b, double limit);

}  // namespace toposcope
