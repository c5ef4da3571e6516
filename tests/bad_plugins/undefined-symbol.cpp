// SPDX-License-Identifier: BSD-3-Clause
#include "centroid_shape.h"

// Declared and defined nowhere.
extern "C" double toposcope_test_undefined_function(double);

namespace {
class CallsNothing : public CentroidShape {
 public:
  using CentroidShape::CentroidShape;
  double distance(const toposcope::FittedShape&, const toposcope::Vec3& point) const override {
    return toposcope_test_undefined_function(point.x());
  }
};
}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, CallsNothing,
                 {.id = "undefined-symbol",
                  .version = "1.0.0",
                  .summary = "The centroid of the points",
                  .min_arity = 1,
                  .max_arity = 1,
                  .dimension = 0})
