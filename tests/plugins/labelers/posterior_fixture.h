// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/plugins.h"
#include "toposcope/labeling.h"

namespace toposcope::test {

inline LabelingOutcome solve_posterior(const LabelingProblem& problem, const Settings& settings = {},
                                       const LabelingRequest& request = {}) {
  return labeler("posterior", settings)->solve(problem, request, context());
}

}  // namespace toposcope::test
