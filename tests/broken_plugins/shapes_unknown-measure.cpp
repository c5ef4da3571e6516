// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    toposcope::FittedShape shape = Shape::fit(input, arguments, context);
    if (shape.summary.usable() && input.points.size() > 50) shape.measures.push_back({"girth", 1, 0.1});
    return shape;
  }
};
}  // namespace

BROKEN_SHAPE("unknown-measure", Broken)
