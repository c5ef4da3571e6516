// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  /// A length that is right in one unit alone.
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    toposcope::FittedShape shape = Shape::fit(input, arguments, context);
    if (shape.summary.usable()) shape.measures[0].value += 0.1;
    return shape;
  }
};
}  // namespace

BROKEN_SHAPE("knows-millimetres", Broken)
