// SPDX-License-Identifier: BSD-3-Clause
// Three or more features are equally spaced on a circle, as the holes of a flange.

#include <algorithm>
#include <vector>

#include "toposcope/geometry/patterns.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Ring final : public RelationTester {
 public:
  explicit Ring(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    std::vector<Vec3> points;
    for (const RelationOperand& each : input.features) points.push_back(each.shape->centroid);
    const bool equal = arguments.boolean("equal");
    const std::optional<PointCircle> circle = equal ? regular_polygon(points) : point_circle(points);
    RelationResult result;
    if (!circle || !(circle->radius > 0)) {
      result.applicable = false;
      result.why = "the centroids lie on a line or in one place: no circle goes through them";
      return result;
    }
    const double excess =
        std::max({0.0, arguments.real("min") - circle->radius, circle->radius - arguments.real("max")});
    measure_pattern(result, input, circle->rms, equal ? 7 : 6, excess);
    result.tolerance = tolerance_rel_ * circle->radius;
    return result;
  }

 private:
  double tolerance_rel_;  // of the circle's radius
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.03", "0.000001", "1",
     "how far from their places the features may be (root mean square), as part of the circle's radius"},
};
constexpr OptionSpec arguments[] = {
    {"equal", OptionType::boolean, "", "true", "", "",
     "equally spaced; false: on one circle, at any spacing (four or more)"},
    {"min", OptionType::real, "length", "0", "0", "", "least radius of the circle", "", "max"},
    {"max", OptionType::real, "length", "1e30", "0", "", "greatest radius of the circle"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Ring,
                 {.id = "ring",
                  .version = "1.0.0",
                  .summary = "Three or more features are equally spaced on a circle",
                  .unit = "length",
                  .min_arity = 3,
                  .max_arity = 0,
                  .options = options,
                  .arguments = arguments})
