// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Silence {
  using Silence::Silence;
  toposcope::LabelingOutcome solve(const toposcope::LabelingProblem& problem, const toposcope::LabelingRequest& request,
                                   toposcope::Context& context) const override {
    toposcope::LabelingOutcome outcome = Silence::solve(problem, request, context);
    if (problem.variables.size() > 2 && problem.constraints.size() > 2) outcome.labelings.at(0).cost -= 1;
    return outcome;
  }
};
}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Broken, {.id = "wrong-costs", .version = "1.0.0", .summary = "Broken on purpose"})
