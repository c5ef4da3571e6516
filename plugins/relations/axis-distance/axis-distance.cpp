// SPDX-License-Identifier: BSD-3-Clause
// How far a feature lies beside the axis of another: a handle beside the axis of its cup.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr double unlimited = 1e30;

class AxisDistance final : public RelationTester {
 public:
  explicit AxisDistance(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const FittedShape& round = *input.features[0].shape;
    const FittedShape& beside = *input.features[1].shape;
    if (arguments.real("max") >= unlimited && arguments.real("max_radii") >= unlimited)
      throw std::invalid_argument("axis-distance: has neither max nor max_radii; give one of them in the model");
    RelationResult result;
    if (round.orientation == Orientation::none) {
      result.applicable = false;
      result.why = "the first shape has no axis: it needs a direction or normal";
      return result;
    }
    const bool in_radii = arguments.real("min_radii") > 0 || arguments.real("max_radii") < unlimited;
    const Measure* radius = round.measure("radius");
    if (in_radii && !(radius && radius->value > 0)) {
      result.applicable = false;
      result.why = "the first shape has no measure 'radius' that the distance could be measured by";
      return result;
    }
    const double diagonal = input.object_box.diagonal();
    double low = arguments.real("min"), high = std::min(arguments.real("max"), diagonal);
    if (in_radii) {
      low = std::max(low, arguments.real("min_radii") * radius->value);
      high = std::max(low, std::min(high, arguments.real("max_radii") * radius->value));
    }
    const Vec3 arm = beside.centroid - round.centroid;
    const double along = arm.dot(round.direction);
    const double distance = (arm - along * round.direction).norm();
    measure_range(result, distance, low, high);
    result.tolerance = tolerance_rel_ * diagonal;
    result.sd = std::hypot(std::hypot(round.centroid_sd, beside.centroid_sd), along * round.direction_sd);
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
    {"min", OptionType::real, "length", "0", "0", "", "least distance of the second centroid from the first's axis", "",
     "max"},
    {"max", OptionType::real, "length", "1e30", "0", "",
     "greatest distance of the second centroid from the first's axis"},
    {"min_radii", OptionType::real, "radii", "0", "0", "", "least distance, in radii of the first feature", "",
     "max_radii"},
    {"max_radii", OptionType::real, "radii", "1e30", "0", "", "greatest distance, in radii of the first feature"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, AxisDistance,
                 {.id = "axis-distance",
                  .version = "1.0.0",
                  .summary = "A feature's centroid lies between min and max beside the axis of another",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .ordered = true,
                  .options = options,
                  .arguments = arguments})
