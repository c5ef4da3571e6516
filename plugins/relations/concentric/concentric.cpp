// SPDX-License-Identifier: BSD-3-Clause
// The concentric relation: dissertation 4.6, as one length instead of an angle and an angle; for circles, and for
// whatever else has an axis and a radius.

#include <algorithm>
#include <cmath>

#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

/// Radius of a shape that is round about its normal or direction, or 0: of a circle, cylinder, cone; a torus' ring.
double radius_of(const FittedShape& shape) {
  if (shape.orientation == Orientation::none) return 0;
  const Measure* radius = shape.measure("radius");
  if (!radius) radius = shape.measure("major_radius");
  return radius ? radius->value : 0;
}

class Concentric final : public RelationTester {
 public:
  explicit Concentric(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const FittedShape& first = *input.features[0].shape;
    const FittedShape& second = *input.features[1].shape;
    const double radius = std::min(radius_of(first), radius_of(second));
    RelationResult result;
    if (!(radius > 0)) {
      result.applicable = false;
      result.why =
          "only round shapes are concentric: both need a normal or direction, and a positive measure 'radius' or "
          "'major_radius'";
      return result;
    }
    // The signs of the normals mean nothing: turn the second towards the first before taking their mean.
    const double sign = first.direction.dot(second.direction) < 0 ? -1 : 1;
    const Vec3 axis = (first.direction + sign * second.direction).normalized();
    const Vec3 between = second.centroid - first.centroid;
    const double along = axis.dot(between);
    const double offset = (between - along * axis).norm();
    const double tilt = std::sin(line_angle(first.direction, second.direction));

    result.residual = std::sqrt(offset * offset + radius * radius * tilt * tilt / 2);
    result.tolerance = tolerance_rel_ * radius;
    // Per component: the centres move the offset directly, the mean normal over the lever between the centres, and the
    // angle of the normals tilts the smaller circle.
    const double direction_sd = angle_sd(first, second);
    result.sd = std::sqrt(first.centroid_sd * first.centroid_sd + second.centroid_sd * second.centroid_sd +
                          (along * along / 4 + radius * radius / 2) * direction_sd * direction_sd);
    result.dof = 2;
    // An unrelated axis crosses the plane of the circle anywhere in a disk of radius a/2: density 2 r / R^2.
    const double disk = input.object_box.a() / 2;
    result.clutter_density = 2 / (disk * disk);
    return result;
  }

 private:
  double tolerance_rel_;  // of the smaller radius
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "smaller radii", "0.15", "0.0001", "10",
     "largest displacement at which the features count as concentric"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Concentric,
                 {.id = "concentric",
                  .version = "1.1.0",
                  .summary = "Two round features have one axis: circles, cylinders, cones, tori",
                  .citation = "Neal 1999, section 4.6",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options})
