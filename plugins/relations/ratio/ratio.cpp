// SPDX-License-Identifier: BSD-3-Clause
// The sizes of two features are in a ratio between bounds.

#include "toposcope/geometry/sizes.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Ratio final : public RelationTester {
 public:
  explicit Ratio(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const Sizes sizes = common_measure(*input.features[0].shape, *input.features[1].shape, arguments.text("measure"));
    RelationResult result;
    if (!sizes.first) {
      result.applicable = false;
      result.why = no_common_measure;
      return result;
    }
    measure_ratio(result, sizes, arguments.real("min"), arguments.real("max"));
    result.tolerance = tolerance_rel_ * (sizes.first->value + sizes.second->value) / 2;
    return result;
  }

 private:
  double tolerance_rel_;  // of the mean of the two
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.02", "0.0001", "2",
     "how far beyond the model's range the first size may lie, as part of the mean of the two"},
};
constexpr OptionSpec arguments[] = {
    {"min", OptionType::real, "", "0", "0", "", "least ratio of the first size to the second", "", "max"},
    {"max", OptionType::real, "", "1e30", "0", "", "greatest ratio of the first size to the second"},
    {"measure", OptionType::text, "", "any", "", "",
     "what is compared, as radius or length; any: the first that both have"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Ratio,
                 {.id = "ratio",
                  .version = "1.0.0",
                  .summary = "The size of the first feature over that of the second lies between min and max",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .ordered = true,
                  .options = options,
                  .arguments = arguments})
