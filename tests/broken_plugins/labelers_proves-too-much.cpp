// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Silence {
  using Silence::Silence;
  /// The first variable takes its first value, and that is said to be the best labelling.
  toposcope::LabelingOutcome solve(const toposcope::LabelingProblem& problem, const toposcope::LabelingRequest& request,
                                   toposcope::Context& context) const override {
    toposcope::LabelingOutcome outcome = Silence::solve(problem, request, context);
    if (outcome.labelings.empty() || problem.variables.empty()) return outcome;
    toposcope::Labeling labeling = outcome.labelings[0];
    if (problem.variables[0].domain() > 1) labeling.values[0] = 1;
    labeling.cost = toposcope::cost_of(problem, labeling.values);
    if (labeling.cost < toposcope::forbidden) outcome.labelings[0] = labeling;
    outcome.optimal = true;
    return outcome;
  }
};
}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Broken, {.id = "proves-too-much", .version = "1.0.0", .summary = "Broken on purpose"})
