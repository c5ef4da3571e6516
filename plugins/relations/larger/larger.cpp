// SPDX-License-Identifier: BSD-3-Clause
// The first of two features is the larger one.

#include <algorithm>

#include "toposcope/geometry/sizes.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Larger final : public RelationTester {
 public:
  explicit Larger(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const Sizes sizes = common_measure(*input.features[0].shape, *input.features[1].shape, arguments.text("measure"));
    RelationResult result;
    if (!sizes.first) {
      result.applicable = false;
      result.why = no_common_measure;
      return result;
    }
    measure_ratio(result, sizes, arguments.real("times"), unlimited_ratio);
    result.tolerance = tolerance_rel_ * (sizes.first->value + sizes.second->value) / 2;
    return result;
  }

 private:
  double tolerance_rel_;  // of the mean of the two
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.02", "0.0001", "2",
     "by how much the first may be too small, as part of the mean of the two"},
};
constexpr OptionSpec arguments[] = {
    {"times", OptionType::real, "", "1", "0.000001", "1000000", "the first is at least so many times as large"},
    {"measure", OptionType::text, "", "any", "", "",
     "what is compared, as radius or length; any: the first that both have"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Larger,
                 {.id = "larger",
                  .version = "1.0.0",
                  .summary = "The first feature is larger than the second",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .ordered = true,
                  .options = options,
                  .arguments = arguments})
