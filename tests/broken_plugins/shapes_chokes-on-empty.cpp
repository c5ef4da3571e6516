// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    if (input.points.empty()) throw std::invalid_argument("no points");
    return Shape::fit(input, arguments, context);
  }
};
}  // namespace

BROKEN_SHAPE("chokes-on-empty", Broken)
