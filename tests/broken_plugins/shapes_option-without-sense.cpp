// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  explicit Broken(const toposcope::Options& options) : Shape(options), part_(options.real("part")) {}
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options& arguments,
                             toposcope::Context& context) const override {
    toposcope::FittedShape shape = Shape::fit(input, arguments, context);
    shape.explained /= part_;  // 0 is within the range
    return shape;
  }
  double part_;
};
const toposcope::OptionSpec options[] = {
    {"part", toposcope::OptionType::real, "", "1", "0", "1", "of the points that counts"}};
}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, Broken,
                 {.id = "option-without-sense",
                  .version = "1.0.0",
                  .summary = "Broken on purpose",
                  .min_arity = 1,
                  .dimension = 0,
                  .options = options,
                  .provides = sound::reach})
