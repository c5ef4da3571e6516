// SPDX-License-Identifier: BSD-3-Clause
// Which of two features a third belongs to: the stabiliser on the port wing's side.

#include <algorithm>
#include <cmath>

#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Nearer final : public RelationTester {
 public:
  explicit Nearer(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const FittedShape& self = *input.features[0].shape;
    const FittedShape& near = *input.features[1].shape;
    const FittedShape& far = *input.features[2].shape;
    // By the triangle inequality the difference lies within the distance of the two: held, in its lower half.
    const double between = (near.centroid - far.centroid).norm();
    const double difference = (self.centroid - near.centroid).norm() - (self.centroid - far.centroid).norm();
    RelationResult result;
    if (!(between > 0)) {
      result.applicable = false;
      result.why = "the second and the third feature have one centroid";
      return result;
    }
    result.residual = std::max(0.0, difference);
    result.tolerance = tolerance_rel_ * between;
    result.sd = std::hypot(self.centroid_sd, near.centroid_sd, far.centroid_sd);
    result.dof = 1;
    result.slack = between;
    result.clutter_density = 1 / (2 * between);
    return result;
  }

 private:
  double tolerance_rel_;  // of the distance between the second and the third feature
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.02", "0.000001", "1",
     "by how much the third may be nearer, as part of the distance between second and third"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Nearer,
                 {.id = "nearer",
                  .version = "1.0.0",
                  .summary = "The first feature is nearer to the second than to the third",
                  .unit = "length",
                  .min_arity = 3,
                  .max_arity = 3,
                  .ordered = true,
                  .options = options})
