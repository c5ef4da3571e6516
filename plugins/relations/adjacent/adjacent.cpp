// SPDX-License-Identifier: BSD-3-Clause
// Two features touch, or nearly: the least distance between their points.

#include <algorithm>
#include <cmath>

#include "toposcope/geometry/point_sets.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr double far_tolerances = 10;  // where the boxes are farther apart than this their gap is all that counts

/// The points of the working sets; of a shape without any, its outline.
std::span<const Vec3> points_of(const RelationOperand& feature) {
  return feature.points.empty() ? std::span<const Vec3>(feature.shape->outline) : feature.points;
}

bool usable(std::span<const Vec3> points) {
  return !points.empty() && std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
}

/// No two points of the features are closer than this.
double gap_of_boxes(const RelationOperand& first, const RelationOperand& second) {
  if (first.points.empty() || second.points.empty()) return 0;
  return (first.box.center - second.box.center).norm() - (first.box.diagonal() + second.box.diagonal()) / 2;
}

class Adjacent final : public RelationTester {
 public:
  explicit Adjacent(const Options& options) : gap_(options.real("gap")), tolerance_(options.real("tolerance")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const std::span<const Vec3> first = points_of(input.features[0]), second = points_of(input.features[1]);
    RelationResult result;
    if (!usable(first) || !usable(second)) {
      result.applicable = false;
      result.why = "a feature without points touches nothing";
      return result;
    }
    const double gap = gap_ * input.mean_edge;
    result.tolerance = tolerance_ * input.mean_edge;
    const double apart = gap_of_boxes(input.features[0], input.features[1]);
    const double distance = apart > gap + far_tolerances * result.tolerance ? apart : least_distance(first, second);
    result.residual = std::max(0.0, distance - gap);
    // The points themselves are compared, not the fitted shapes: the fits' uncertainty plays no part.
    result.sd = 0;
    result.dof = 1;
    result.slack = gap;
    result.clutter_density = 2 / input.object_box.diagonal();
    return result;
  }

 private:
  double gap_, tolerance_;  // mean edges
};

constexpr OptionSpec options[] = {
    {"gap", OptionType::real, "mean-edges", "1.5", "0", "1000",
     "features so far apart touch: no two have a vertex in common, so that neighbours are an edge apart"},
    {"tolerance", OptionType::real, "mean-edges", "1.5", "0.001", "1000", "how much farther apart they may be"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Adjacent,
                 {.id = "adjacent",
                  .version = "1.0.0",
                  .summary = "Two features touch: their nearest points are about an edge apart",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options})
