// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Relation {
  using Relation::Relation;
  toposcope::RelationResult test(const toposcope::RelationInput& input, const toposcope::Options& arguments,
                                 toposcope::Context& context) const override {
    toposcope::RelationResult result = Relation::test(input, arguments, context);
    if (!input.features[0].shape->outline.empty()) result.tolerance = 0;
    return result;
  }
};
}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Broken,
                 {.id = "no-tolerance",
                  .version = "1.0.0",
                  .summary = "Broken on purpose",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2})
