// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    toposcope::FittedShape shape = Shape::fit(input, arguments, context);
    if (context.threads() == 3) shape.explained = 2;
    return shape;
  }
};
}  // namespace

BROKEN_SHAPE("depends-on-threads", Broken)
