// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "plugin/manifest.h"
#include "probability/likelihood.h"
#include "toposcope/options.h"

namespace toposcope {

/// The kernel's own options: the `probability` section of a pipeline manifest (docs/theory/probabilities.md).
std::span<const OptionRow> probability_option_table();

/// \pre checked against the table
ProbabilityModel probability_model(const Options& options);

}  // namespace toposcope
