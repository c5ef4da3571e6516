// SPDX-License-Identifier: BSD-3-Clause
// One feature lies above another. What is up, features of the model say: meshes lie anyhow.

#include <algorithm>
#include <cmath>
#include <string>

#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

/// A direction, and its standard deviation (rad).
struct Up {
  Vec3 direction = Vec3::Zero();
  double sd = 0;
};

/// From one feature towards another, by their centroids.
Up from_to(const FittedShape& from, const FittedShape& to) {
  const Vec3 way = to.centroid - from.centroid;
  const double length = way.norm();
  if (!(length > 0)) return {};
  return {way / length, std::min(std::hypot(from.centroid_sd, to.centroid_sd) / length, pi / 2)};
}

/// Along the axis of `top`, to the side on which it lies of `bottom`; no direction where they lie level.
Up towards(const FittedShape& bottom, const FittedShape& top, double level) {
  if (top.orientation == Orientation::none) return from_to(bottom, top);
  const double rise = (top.centroid - bottom.centroid).dot(top.direction);
  if (!(std::abs(rise) > level)) return {};
  return {rise < 0 ? Vec3(-top.direction) : top.direction, std::min(top.direction_sd, pi / 2)};
}

class Above final : public RelationTester {
 public:
  explicit Above(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const FittedShape& upper = *input.features[0].shape;
    const FittedShape& lower = *input.features[1].shape;
    const FittedShape& third = *input.features[2].shape;
    const double diagonal = input.object_box.diagonal(), least = arguments.real("min");
    RelationResult result;
    result.tolerance = tolerance_rel_ * diagonal;
    const bool pair = input.features.size() > 3;
    const Up up = pair ? from_to(third, *input.features[3].shape) : towards(lower, third, result.tolerance);
    if (!(up.direction.squaredNorm() > 0)) {
      result.applicable = false;
      result.why =
          pair ? "the third and the fourth feature have one centroid: they do not say what is up"
               : "the third feature lies level with the second along its own normal or axis, which may not be "
                 "the direction that is meant; name two features instead, [upper, lower, from, to], and the way "
                 "from one to the other is up";
      return result;
    }
    const Vec3 between = upper.centroid - lower.centroid;
    const double height = between.dot(up.direction);
    const double lateral = (between - height * up.direction).norm();
    result.residual = std::max(0.0, least - height);
    result.sd = std::hypot(std::hypot(upper.centroid_sd, lower.centroid_sd), lateral * up.sd);
    result.dof = 1;
    // Of unrelated features either is as often the upper one, by anything up to the diagonal.
    result.slack = std::max(0.0, diagonal - least);
    result.clutter_density = 1 / (2 * diagonal);
    return result;
  }

 private:
  double tolerance_rel_;  // of the object box's diagonal
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "diagonals", "0.01", "0.000001", "1",
     "by how much the first may lie below where it should"},
};
constexpr OptionSpec arguments[] = {
    {"min", OptionType::real, "length", "0", "0", "", "least height of the first feature's centroid over the second's"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Above,
                 {.id = "above",
                  .version = "1.0.0",
                  .summary = "The first feature lies above the second, towards the third",
                  .citation = "Neal 1999, section 3.2 (directions along the object's own axes)",
                  .unit = "length",
                  .min_arity = 3,
                  .max_arity = 4,
                  .ordered = true,
                  .options = options,
                  .arguments = arguments})
