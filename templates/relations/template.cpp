// SPDX-License-Identifier: BSD-3-Clause
// Two features stand equally far from the centre of the object's box.
#include <cmath>

#include "toposcope/plugin.h"

namespace {
using namespace toposcope;

struct Tester final : RelationTester {
  explicit Tester(const Options& options) : tolerance_rel(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options&, Context&) const override {
    const FittedShape& first = *input.features[0].shape;
    const FittedShape& second = *input.features[1].shape;
    const Vec3& center = input.object_box.center;
    RelationResult result;
    result.residual = std::abs((first.centroid - center).norm() - (second.centroid - center).norm());
    result.tolerance = tolerance_rel * input.object_box.diagonal();
    result.sd = std::hypot(first.centroid_sd, second.centroid_sd);
    // Unrelated features stand anywhere from the centre to the ends of the box: the difference of two distances drawn
    // evenly from 0 to h has the density 2 (h - x) / h^2; never 0, so that what cannot be is not impossible.
    const double h = input.object_box.diagonal() / 2;
    result.clutter_density = h > 0 ? 2 * std::max(h - result.residual, 0.05 * h) / (h * h) : 1;
    if (!(result.tolerance > 0)) {
      result.applicable = false;
      result.why = "the object has no extent";
    }
    return result;
  }

  double tolerance_rel;
};

const OptionSpec options[] = {{"tolerance_rel", OptionType::real, "diagonals", "0.02", "0.000001", "1",
                               "largest difference at which the distances count as equal"}};
}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Tester,
                 {.id = "@ID@",
                  .version = "0.1.0",
                  .summary = "Equally far from the centre of the object's box",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options})
