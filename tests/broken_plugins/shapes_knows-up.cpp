// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  using Shape::Shape;
  /// The reach along z.
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    toposcope::FittedShape shape = Shape::fit(input, arguments, context);
    if (!shape.summary.usable()) return shape;
    double squares = 0;
    for (const toposcope::Vec3& point : input.points) squares += std::pow(point.z() - shape.centroid.z(), 2);
    shape.measures[0] = {"reach", std::sqrt(squares / static_cast<double>(input.points.size())),
                         1e-6 * input.mean_edge};
    return shape;
  }
};
}  // namespace

BROKEN_SHAPE("knows-up", Broken)
