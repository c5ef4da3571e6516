// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Why values were removed, in words, read from the trail.

#include <string>
#include <vector>

#include "toposcope/labeling/crisp_propagation.h"

namespace toposcope::discrete_relaxation {

/// The value's own name, "missing", or its number.
std::string value_name(const LabelingVariable& variable, Index value);

/// Of what was struck by arc consistency alone, in the order in which it was removed: first what was never open,
/// *missing* not counted, then the trail.
std::vector<RemovedValue> reasons(const CrispDomains& domains);

}  // namespace toposcope::discrete_relaxation
