// SPDX-License-Identifier: BSD-3-Clause
// Two features are equally large.

#include <cmath>

#include "toposcope/geometry/sizes.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class SameSize final : public RelationTester {
 public:
  explicit SameSize(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const Sizes sizes = common_measure(*input.features[0].shape, *input.features[1].shape);
    RelationResult result;
    if (!sizes.first) {
      result.applicable = false;
      result.why = no_common_measure;
      return result;
    }
    const double mean = (sizes.first->value + sizes.second->value) / 2;
    result.residual = std::abs(sizes.first->value - sizes.second->value);
    result.tolerance = tolerance_rel_ * mean;
    result.sd = std::hypot(sizes.first->sd, sizes.second->sd);
    result.dof = 1;
    // Of two unrelated sizes of this mean each lies anywhere from 0 to twice the mean: so does their difference.
    result.clutter_density = 1 / (2 * mean);
    return result;
  }

 private:
  double tolerance_rel_;  // of the mean of the two
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.1", "0.0001", "2",
     "largest difference at which the sizes count as the same, as part of their mean"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, SameSize,
                 {.id = "same-size",
                  .version = "1.0.0",
                  .summary = "Two features are equally large: the first measure that both have",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options})
