// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  /// The reach from the origin.
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    toposcope::FittedShape shape = Shape::fit(input, arguments, context);
    if (shape.summary.usable()) shape.measures[0].value = shape.centroid.norm();
    return shape;
  }
};
}  // namespace

BROKEN_SHAPE("knows-the-origin", Broken)
