// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Silence {
  using Silence::Silence;
  /// The evidence of one labelling is said to be that of all.
  toposcope::LabelingOutcome solve(const toposcope::LabelingProblem& problem, const toposcope::LabelingRequest& request,
                                   toposcope::Context& context) const override {
    toposcope::LabelingOutcome outcome = Silence::solve(problem, request, context);
    if (outcome.labelings.empty()) return outcome;
    outcome.log_evidence = -outcome.labelings[0].cost;
    outcome.evidence_exactness = toposcope::Exactness::exact;
    return outcome;
  }
};
}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Broken, {.id = "claims-exactness", .version = "1.0.0", .summary = "Broken on purpose"})
