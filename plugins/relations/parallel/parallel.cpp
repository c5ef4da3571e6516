// SPDX-License-Identifier: BSD-3-Clause
// The parallel relation: dissertation 4.6 with its dot products put right (|n1.n2| near 1), and like compared with
// like.

#include <algorithm>
#include <cmath>

#include "toposcope/geometry/lines.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Parallel final : public RelationTester {
 public:
  explicit Parallel(const Options& options) : tolerance_(options.real("tolerance") * pi / 180) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const FittedShape& first = *input.features[0].shape;
    const FittedShape& second = *input.features[1].shape;
    RelationResult result;
    if (first.orientation == Orientation::none || second.orientation == Orientation::none) {
      result.applicable = false;
      result.why = "a shape without a direction or normal is parallel to nothing";
      return result;
    }
    const double angle = line_angle(first.direction, second.direction);
    const bool like = first.orientation == second.orientation;
    result.tolerance = tolerance_;
    // A direction that is wholly uncertain is off by a right angle at most.
    result.sd = std::min(std::hypot(first.direction_sd, second.direction_sd), pi / 2);
    if (like) {
      result.residual = angle;
      result.dof = 2;
      result.clutter_density = angle > 0 ? std::sin(angle) / angle : 1;
    } else {
      // A line is parallel to a plane when it is perpendicular to the plane's normal.
      result.residual = pi / 2 - angle;
      result.dof = 1;
      // Never 0: at a right angle the relation fails whatever is unrelated.
      result.clutter_density = std::max(std::cos(result.residual), 0.05);
    }
    return result;
  }

 private:
  double tolerance_;  // rad
};

constexpr OptionSpec options[] = {
    {"tolerance", OptionType::real, "deg", "10", "0.01", "90", "largest angle at which the features count as parallel"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Parallel,
                 {.id = "parallel",
                  .version = "1.0.0",
                  .summary = "Two normals or directions are parallel, or a line is parallel to a plane",
                  .citation = "Neal 1999, section 4.6 (with erratum: |n1.n2| near 1)",
                  .unit = "deg",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options})
