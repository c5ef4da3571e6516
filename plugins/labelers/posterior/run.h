// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One run of the plugin over one problem: which method, and what it tells of it.

#include <cstdint>
#include <string>

#include "toposcope/labeling.h"

namespace toposcope::posterior {

struct Settings {
  std::string method;
  double max_entries, tolerance, damping;
  std::uint64_t max_sweeps;
};

/// \pre the problem passed `check` and has variables
LabelingOutcome run(const Settings& settings, const LabelingProblem& problem, const LabelingRequest& request,
                    Context& context);

}  // namespace toposcope::posterior
