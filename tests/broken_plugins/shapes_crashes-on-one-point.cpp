// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>

#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    if (input.points.size() == 1) std::raise(SIGSEGV);
    return Shape::fit(input, arguments, context);
  }
};
}  // namespace

BROKEN_SHAPE("crashes-on-one-point", Broken)
