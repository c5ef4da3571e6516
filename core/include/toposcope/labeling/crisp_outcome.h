// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the crisp labelers make of their outcomes alike.

#include "toposcope/labeling.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {

/// No labelling costs less: the least of every table, summed. -infinity where the deadline came first.
double sum_of_minima(const LabelingProblem& problem, Deadline& deadline);

/// The outcome where no consistent labelling was found: all missing, where that may be.
/// \param proven  none exists under the labeler's rules
LabelingOutcome without_labeling(const LabelingProblem& problem, bool proven);

/// The outcome of a problem without variables.
LabelingOutcome without_variables(const LabelingProblem& problem);

/// Whether a variable may be missing.
bool any_optional(const LabelingProblem& problem);

/// How many variables are missing.
Index count_missing(const LabelingProblem& problem, std::span<const Index> values);

}  // namespace toposcope
