// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  toposcope::FittedShape fit(const toposcope::FitInput&, const toposcope::Options&,
                             toposcope::Context&) const override {
    throw std::out_of_range("point 7 of 3");
  }
};
}  // namespace

BROKEN_SHAPE("throws-always", Broken)
