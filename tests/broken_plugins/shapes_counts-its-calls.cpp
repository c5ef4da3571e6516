// SPDX-License-Identifier: BSD-3-Clause
#include <atomic>

#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    toposcope::FittedShape shape = Shape::fit(input, arguments, context);
    // From the tenth call of an object on: only a check that calls it often finds it.
    if (shape.summary.usable() && ++calls_ > 9) shape.explained = 2 + calls_;
    return shape;
  }
  mutable std::atomic<int> calls_ = 0;
};
}  // namespace

BROKEN_SHAPE("counts-its-calls", Broken)
