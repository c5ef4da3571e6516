// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pipeline/stations.h"
#include "toposcope/labeling.h"

namespace toposcope {

/// What it took to solve a problem, ms.
struct SolveTimes {
  double label_ms = 0, marginals_ms = 0;
};

/// Solves a labelling problem and checks the outcome. \throw PluginError  the labeler threw, or check_outcome did
LabelingOutcome solve(const LabelerStation& labeler, const LabelingProblem& problem, const LabelingRequest& request,
                      Context& context);

/// Moves the sums over labellings, evidence and posteriors with what is promised of them, from one outcome of a problem
/// to another.
void take_sums(LabelingOutcome& from, LabelingOutcome& to);

/// Refuses an outcome that breaks the labelers' contract: no labelling, values out of range, two features that share a
/// vertex, a bound above a labelling's cost, sums without a word on their exactness, posteriors of the wrong size or
/// that do not sum to 1. \throw PluginError
void check_outcome(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& plugin);

}  // namespace toposcope
