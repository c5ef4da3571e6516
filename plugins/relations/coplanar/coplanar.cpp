// SPDX-License-Identifier: BSD-3-Clause
// Two features lie in one plane: plane and plane, or a line in a plane.

#include <algorithm>
#include <cmath>

#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

/// Greatest distance of a feature's outline, or of its centroid, from `center`.
double reach_of(const FittedShape& shape, const Vec3& center) {
  double squared = (shape.centroid - center).squaredNorm();
  for (const Vec3& point : shape.outline) squared = std::max(squared, (point - center).squaredNorm());
  return std::sqrt(squared);
}

/// Like normals of planes: turned to one side.
Vec3 mean_normal(const FittedShape& first, const FittedShape& second) {
  const double sign = first.direction.dot(second.direction) < 0 ? -1 : 1;
  return (first.direction + sign * second.direction) / 2;
}

class Coplanar final : public RelationTester {
 public:
  explicit Coplanar(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const FittedShape& first = *input.features[0].shape;
    const FittedShape& second = *input.features[1].shape;
    const Vec3 between = second.centroid - first.centroid, center = first.centroid + between / 2;
    const double reach = std::max(reach_of(first, center), reach_of(second, center));
    const bool planes = first.orientation == Orientation::plane_like && second.orientation == Orientation::plane_like;
    const bool line = !planes &&
                      (first.orientation == Orientation::plane_like || second.orientation == Orientation::plane_like) &&
                      first.orientation != Orientation::none && second.orientation != Orientation::none;
    RelationResult result;
    if (!(planes || line) || !(reach > 0)) {
      result.applicable = false;
      result.why = planes || line ? "both features are one point"
                                  : "one shape at least needs a normal, and the other a normal or a direction; for two "
                                    "lines use 'axes-meet' or 'parallel'";
      return result;
    }
    // Offset and slope of the one against the other about the middle between them.
    const FittedShape& plane = first.orientation == Orientation::plane_like ? first : second;
    const Vec3 normal = planes ? mean_normal(first, second) : plane.direction;
    const double angle = line_angle(first.direction, second.direction);
    const double offset = between.dot(normal), slope = planes ? std::sin(angle) : std::cos(angle);
    const double lateral = std::sqrt(std::max(0.0, between.squaredNorm() - offset * offset)) / 2;
    result.residual = std::sqrt(offset * offset + reach * reach * slope * slope / 2);
    result.tolerance = tolerance_rel_ * reach;
    const double direction_sd = angle_sd(first, second);
    result.sd = std::sqrt(first.centroid_sd * first.centroid_sd + second.centroid_sd * second.centroid_sd +
                          (lateral * lateral + reach * reach / 2) * direction_sd * direction_sd);
    result.dof = planes ? 3 : 2;
    // An unrelated plane passes anywhere within half of the box's mean side, turned anyhow; see the page.
    const double mean_side = (input.object_box.a() + input.object_box.b() + input.object_box.c()) / 3;
    result.clutter_density = planes ? 4 / (mean_side * reach * reach) : std::sqrt(2.0) * pi / (mean_side * reach);
    return result;
  }

 private:
  double tolerance_rel_;  // of the reach of the two
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "reaches", "0.1", "0.0001", "10",
     "largest distance of the planes that counts as none, as part of how far the features reach"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Coplanar,
                 {.id = "coplanar",
                  .version = "1.0.0",
                  .summary = "Two features lie in one plane: plane and plane, or a line in a plane",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options})
