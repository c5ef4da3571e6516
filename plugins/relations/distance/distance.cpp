// SPDX-License-Identifier: BSD-3-Clause
// How far apart two features are along or across the axis of a third.

#include <algorithm>
#include <cmath>

#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Distance final : public RelationTester {
 public:
  explicit Distance(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const FittedShape& first = *input.features[0].shape;
    const FittedShape& second = *input.features[1].shape;
    const FittedShape& axis = *input.features[2].shape;
    RelationResult result;
    if (axis.orientation == Orientation::none) {
      result.applicable = false;
      result.why = "the third shape has neither normal nor axis; name a feature that has one";
      return result;
    }
    const Vec3 between = second.centroid - first.centroid;
    const double along = std::abs(between.dot(axis.direction));
    const double across = (between - between.dot(axis.direction) * axis.direction).norm();
    const bool is_along = arguments.text("way") == "along";
    const double diagonal = input.object_box.diagonal(), high = std::max(arguments.real("min"), diagonal);
    measure_range(result, is_along ? along : across, arguments.real("min"), std::min(arguments.real("max"), high));
    result.tolerance = tolerance_rel_ * diagonal;
    // A tilt of the axis moves the foot by what lies at a right angle to the way.
    result.sd = std::hypot(first.centroid_sd, second.centroid_sd, (is_along ? across : along) * axis.direction_sd);
    result.clutter_density = 1 / diagonal;
    return result;
  }

 private:
  double tolerance_rel_;  // of the object box's diagonal
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "diagonals", "0.01", "0.000001", "1",
     "how far beyond the model's range the distance may lie"},
};
constexpr OptionSpec arguments[] = {
    {"way", OptionType::text, "", "along", "", "", "along the third's axis, or across it", "along|across"},
    {"min", OptionType::real, "length", "0", "0", "", "least distance of the centroids on that way", "", "max"},
    {"max", OptionType::real, "length", "1e30", "0", "", "greatest distance of the centroids on that way"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Distance,
                 {.id = "distance",
                  .version = "1.0.0",
                  .summary = "Two features are between min and max apart along or across the axis of a third",
                  .unit = "length",
                  .min_arity = 3,
                  .max_arity = 3,
                  .ordered = true,
                  .options = options,
                  .arguments = arguments})
