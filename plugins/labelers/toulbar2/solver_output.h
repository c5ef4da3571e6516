// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope::toulbar2 {

/// What toulbar2 -s=1 printed: each better labelling as it was found, and the bounds between which the optimum is.
struct SolverOutput {
  std::vector<Index> values;  ///< of the last labelling; empty: none
  std::optional<double> lower_bound;
  std::optional<double> optimum;  ///< as it was stated
  bool optimal = false, unsatisfiable = false;
  std::uint64_t backtracks = 0, nodes = 0;
  std::string last_line;
};

/// The program may have been killed within its last line: only lines with their end count.
SolverOutput parse_output(const std::string& text, const LabelingProblem& problem);

}  // namespace toposcope::toulbar2
