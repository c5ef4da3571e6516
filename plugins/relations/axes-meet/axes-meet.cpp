// SPDX-License-Identifier: BSD-3-Clause
// The axes of two features meet, or nearly.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

/// Axes closer to parallel than this have no one place where they come nearest.
constexpr double least_sine = 0.1;

class AxesMeet final : public RelationTester {
 public:
  explicit AxesMeet(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const FittedShape& first = *input.features[0].shape;
    const FittedShape& second = *input.features[1].shape;
    RelationResult result;
    if (!directed(first, second)) {
      result.applicable = false;
      result.why = "a shape without a direction or normal has no axis";
      return result;
    }
    const Vec3 normal = first.direction.cross(second.direction), between = second.centroid - first.centroid;
    const double sine = normal.norm();
    if (sine < least_sine) {
      result.applicable = false;
      result.why = "the axes are parallel, or nearly so; use 'concentric' or 'axis-distance'";
      return result;
    }
    result.residual = std::abs(between.dot(normal)) / sine;
    result.tolerance = tolerance_rel_ * input.object_box.diagonal();
    // An error of a direction acts over the way from the centroid to the meeting point.
    const double along_first = between.cross(second.direction).dot(normal) / (sine * sine);
    const double along_second = between.cross(first.direction).dot(normal) / (sine * sine);
    result.sd =
        std::sqrt(std::pow(first.centroid_sd, 2) + std::pow(second.centroid_sd, 2) +
                  std::pow(along_first * first.direction_sd, 2) + std::pow(along_second * second.direction_sd, 2));
    result.dof = 1;
    // Unrelated lines pass each other anywhere within half of the box's mean side.
    result.clutter_density = 6 / (input.object_box.a() + input.object_box.b() + input.object_box.c());
    return result;
  }

 private:
  double tolerance_rel_;  // of the object box's diagonal
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "diagonals", "0.02", "0.000001", "1",
     "largest distance at which the axes count as meeting"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, AxesMeet,
                 {.id = "axes-meet",
                  .version = "1.0.0",
                  .summary = "The axes of two features meet: normals through the centre, directions",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options})
