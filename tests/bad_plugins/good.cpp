// SPDX-License-Identifier: BSD-3-Clause
#include "centroid_shape.h"

TOPOSCOPE_PLUGIN(ShapeFitter, CentroidShape,
                 {.id = "good",
                  .version = "1.0.0",
                  .summary = "The centroid of the points",
                  .min_arity = 1,
                  .max_arity = 1,
                  .dimension = 0})
