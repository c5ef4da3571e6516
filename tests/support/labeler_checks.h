// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a labeler's outcome is held against.

#include <string>
#include <string_view>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope::test {

/// A fact that the outcome tells; "" where it does not.
std::string fact(const LabelingOutcome& outcome, std::string_view name);

/// What every labeler owes: labellings of the problem, each once, that meet its exclusions and cost what they say, no
/// less than the bound; and a guarantee in words.
void expect_sound(const LabelingProblem& problem, const LabelingOutcome& outcome);

/// Further, against the list of `all_labelings`: the bound is below the optimum, and there is a labelling where all
/// features may be missing.
void expect_sound(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::vector<Labeling>& all);

/// Of a labeler that seeks the least cost by steps: sound, the best first, and optimal only where it is.
/// \return true where it found the optimum
bool expect_honest(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::vector<Labeling>& all);

/// \param tolerance  of each probability
void expect_posteriors(const LabelingOutcome& outcome, const std::vector<std::vector<double>>& expected,
                       double tolerance);

}  // namespace toposcope::test
