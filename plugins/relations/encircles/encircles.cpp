// SPDX-License-Identifier: BSD-3-Clause
// A round feature goes around another one: a rim around its opening, a ring of a bearing around the other.

#include <algorithm>
#include <cmath>
#include <string_view>

#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

/// The radius of a round shape: of a torus that of its ring.
const Measure* radius_of(const FittedShape& shape) {
  const Measure* radius = shape.measure("radius");
  return radius ? radius : shape.measure("major_radius");
}

class Encircles final : public RelationTester {
 public:
  explicit Encircles(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const FittedShape& ring = *input.features[0].shape;
    const FittedShape& inner = *input.features[1].shape;
    const Measure* radius = radius_of(ring);
    RelationResult result;
    if (ring.orientation == Orientation::none || !radius || !(radius->value > 0)) {
      result.applicable = false;
      result.why = "the first shape is not round: it needs an axis or normal and a radius";
      return result;
    }
    const auto from_axis = [&](const Vec3& point) {
      const Vec3 arm = point - ring.centroid;
      return (arm - arm.dot(ring.direction) * ring.direction).norm();
    };
    double farthest = from_axis(inner.centroid), height = (inner.centroid - ring.centroid).dot(ring.direction);
    for (const Vec3& point : inner.outline) {
      const double away = from_axis(point);
      if (away > farthest) {
        farthest = away;
        height = (point - ring.centroid).dot(ring.direction);
      }
    }
    const double limit = std::max(0.0, radius->value - arguments.real("clearance"));
    measure_range(result, farthest, 0, limit);
    result.tolerance = tolerance_rel_ * radius->value;
    result.sd = std::hypot(std::hypot(ring.centroid_sd, inner.centroid_sd), radius->sd, height * ring.direction_sd);
    // What is unrelated reaches anywhere from the axis, up to the object's diagonal.
    result.clutter_density = 1 / std::max(limit, input.object_box.diagonal());
    return result;
  }

 private:
  double tolerance_rel_;  // of the first's radius
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.02", "0.000001", "1",
     "how far the second may reach out, as part of the first's radius"},
};
constexpr OptionSpec arguments[] = {
    {"clearance", OptionType::real, "length", "0", "0", "", "least gap between the second and the first"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Encircles,
                 {.id = "encircles",
                  .version = "1.0.0",
                  .summary = "The first feature goes around the second, seen along the first's axis",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .ordered = true,
                  .options = options,
                  .arguments = arguments})
