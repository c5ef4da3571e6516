// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "centroid_shape.h"

namespace {
/// Throws a std::exception from fit and something else from distance.
class ThrowsRunning : public CentroidShape {
 public:
  using CentroidShape::CentroidShape;
  toposcope::FittedShape fit(const toposcope::FitInput&, const toposcope::Options&,
                             toposcope::Context&) const override {
    throw std::out_of_range("point 7 of 3");
  }
  double distance(const toposcope::FittedShape&, const toposcope::Vec3&) const override { throw 42; }
};
}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, ThrowsRunning,
                 {.id = "throws-running",
                  .version = "1.0.0",
                  .summary = "The centroid of the points",
                  .min_arity = 1,
                  .max_arity = 1,
                  .dimension = 0})
