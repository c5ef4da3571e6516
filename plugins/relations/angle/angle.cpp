// SPDX-License-Identifier: BSD-3-Clause
// The directions of two features make an angle between min and max.

#include <algorithm>
#include <cmath>

#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Angle final : public RelationTester {
 public:
  explicit Angle(const Options& options) : tolerance_(options.real("tolerance") * pi / 180) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const FittedShape& first = *input.features[0].shape;
    const FittedShape& second = *input.features[1].shape;
    const double low = arguments.real("min") * pi / 180, high = arguments.real("max") * pi / 180;
    RelationResult result;
    if (!directed(first, second)) {
      result.applicable = false;
      result.why = "a shape without a direction or normal makes no angle";
      return result;
    }
    const double directions = line_angle(first.direction, second.direction);
    // A line that is parallel to a plane's normal is at a right angle to the plane.
    const double angle = first.orientation == second.orientation ? directions : pi / 2 - directions;
    measure_range(result, angle, low, high);
    result.tolerance = tolerance_;
    result.sd = angle_sd(first, second);
    // Of random directions, see the page of `parallel`.
    result.clutter_density = std::max(std::sin(directions), least_angle_density);
    return result;
  }

 private:
  double tolerance_;  // rad
};

constexpr OptionSpec options[] = {
    {"tolerance", OptionType::real, "deg", "5", "0.01", "90", "how far beyond the model's range the angle may lie"},
};
constexpr OptionSpec arguments[] = {
    {"min", OptionType::real, "deg", "0", "0", "90", "least angle", "", "max"},
    {"max", OptionType::real, "deg", "90", "0", "90", "greatest angle"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Angle,
                 {.id = "angle",
                  .version = "1.0.0",
                  .summary = "The directions of two features make an angle between min and max",
                  .unit = "deg",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options,
                  .arguments = arguments})
