// SPDX-License-Identifier: BSD-3-Clause
// One feature lies between two others.

#include <algorithm>
#include <cmath>

#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Between final : public RelationTester {
 public:
  explicit Between(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const FittedShape& self = *input.features[0].shape;
    const FittedShape& from = *input.features[1].shape;
    const FittedShape& to = *input.features[2].shape;
    const Vec3 way = to.centroid - from.centroid;
    const double length = way.norm(), margin = arguments.real("margin");
    RelationResult result;
    if (!(length > 0)) {
      result.applicable = false;
      result.why = "the second and the third feature have one centroid: nothing lies between them";
      return result;
    }
    const Vec3 along = way / length, arm = self.centroid - from.centroid;
    const double at = arm.dot(along), aside = (arm - at * along).norm();
    measure_range(result, at, margin * length, (1 - margin) * length);
    result.tolerance = tolerance_rel_ * length;
    const double turn = std::min(1.0, std::hypot(from.centroid_sd, to.centroid_sd) / length);
    result.sd = std::hypot(self.centroid_sd, std::max(from.centroid_sd, to.centroid_sd), aside * turn);
    // Along the way of two others an unrelated feature lies anywhere on the object.
    result.clutter_density = 1 / std::max(length, input.object_box.diagonal());
    return result;
  }

 private:
  double tolerance_rel_;  // of the distance between the outer two
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.02", "0.000001", "1",
     "how far beyond the outer two the first may lie, as part of their distance"},
};
constexpr OptionSpec arguments[] = {
    {"margin", OptionType::real, "", "0", "0", "0.5", "part of the way that is left free at either end"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Between,
                 {.id = "between",
                  .version = "1.0.0",
                  .summary = "The first feature lies between the second and the third, on their way",
                  .unit = "length",
                  .min_arity = 3,
                  .max_arity = 3,
                  .ordered = true,
                  .options = options,
                  .arguments = arguments})
