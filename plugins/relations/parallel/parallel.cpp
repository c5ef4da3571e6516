// SPDX-License-Identifier: BSD-3-Clause
// The parallel relation: dissertation 4.6 with its dot products put right (|n1.n2| near 1), and like compared with
// like.

#include "toposcope/geometry/residuals.h"
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
    if (!directed(first, second)) {
      result.applicable = false;
      result.why = "a shape without a direction or normal is parallel to nothing";
      return result;
    }
    // A line is parallel to a plane when it is perpendicular to the plane's normal.
    const bool like = first.orientation == second.orientation;
    result = like ? parallel_directions(first, second) : perpendicular_directions(first, second);
    result.tolerance = tolerance_;
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
