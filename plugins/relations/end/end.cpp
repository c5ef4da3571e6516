// SPDX-License-Identifier: BSD-3-Clause
// The object ends at a feature: within reach of its axis nothing lies beyond its plane.

#include <algorithm>
#include <cmath>

#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

/// Greatest distance of the outline from the centroid, square to the direction: a circle's radius.
double size_of(const FittedShape& shape) {
  double size = 0;
  for (const Vec3& point : shape.outline) {
    const Vec3 arm = point - shape.centroid;
    size = std::max(size, (arm - arm.dot(shape.direction) * shape.direction).norm());
  }
  return size;
}

class End final : public RelationTester {
 public:
  explicit End(const Options& options) : reach_(options.real("reach")), tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const FittedShape& shape = *input.features[0].shape;
    const double size = size_of(shape);
    RelationResult result;
    if (shape.orientation != Orientation::plane_like || !(size > 0)) {
      result.applicable = false;
      result.why = "the object can end at a shape with a normal and an extent only: a circle, a plane";
      return result;
    }
    const double reach = reach_ * size;
    double above = 0, below = 0;
    for (const Vec3& point : input.mesh->positions) {
      const Vec3 arm = point - shape.centroid;
      const double height = arm.dot(shape.direction);
      if (arm.squaredNorm() - height * height > reach * reach) continue;
      above = std::max(above, height);
      below = std::max(below, -height);
    }
    result.residual = std::min(above, below);
    result.tolerance = tolerance_rel_ * size;
    result.sd = std::hypot(shape.centroid_sd, reach * std::min(shape.direction_sd, pi / 2));
    result.dof = 1;
    // A plane through any place of the object has up to half of the box's mean side on its lesser side.
    result.clutter_density = 6 / (input.object_box.a() + input.object_box.b() + input.object_box.c());
    return result;
  }

 private:
  double reach_, tolerance_rel_;  // of the feature's size
};

constexpr OptionSpec options[] = {
    {"reach", OptionType::real, "sizes", "1.2", "0.1", "100", "how far from the axis the object is looked at"},
    {"tolerance_rel", OptionType::real, "sizes", "0.2", "0.0001", "10", "how much of the object may lie beyond"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, End,
                 {.id = "end",
                  .version = "1.0.0",
                  .summary = "The object ends at the feature: near its axis nothing lies beyond its plane",
                  .unit = "length",
                  .min_arity = 1,
                  .max_arity = 1,
                  .options = options})
