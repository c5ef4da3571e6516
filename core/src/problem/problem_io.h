// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>

#include "toposcope/labeling.h"

namespace toposcope {

/// A labelling problem as a file holds it.
struct ProblemFile {
  LabelingProblem problem;
  double top = std::numeric_limits<double>::infinity();  ///< a labelling that costs so much or more is no solution
};

/// Reads .json (schemas/problem.schema.json), toulbar2's .cfn and .wcsp, and .uai with its evidence in <file>.evid.
/// \throw UsageError  with file, line, value, constraint and remedy; also for functions that are not supported
ProblemFile read_problem(const std::filesystem::path& path);

/// Writes the format that the extension names. .json loses nothing; .cfn and .wcsp have exclusions as pairwise
/// functions and costs as decimals; .uai has factors exp(-cost). \throw UsageError
void write_problem(const std::filesystem::path& path, const LabelingProblem& problem);

}  // namespace toposcope
