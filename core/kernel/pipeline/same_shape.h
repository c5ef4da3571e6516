// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "toposcope/shapes.h"

namespace toposcope {

/// Whether each of two shapes of one fitter lies within `limit` of the other, on the average over its outline.
bool same_shape(const ShapeFitter& fitter, const FittedShape& a, const FittedShape& b, double limit);

}  // namespace toposcope
