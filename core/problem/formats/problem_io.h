// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reading/problem_file.h"

namespace toposcope {

/// Reads .json (schemas/problem.schema.json), toulbar2's .cfn and .wcsp, and .uai with its evidence in <file>.evid.
/// Variables of the last three may not be missing. The locale plays no role.
/// \throw UsageError  with file, line, value, constraint and remedy; also for functions that are not supported
ProblemFile read_problem(const std::filesystem::path& path);

/// Writes the format that the extension names, whole or not at all. .json loses nothing; .cfn and .wcsp have exclusions
/// as pairwise functions and costs as decimals; .uai has factors exp(-cost).
/// \return what the format could not keep, one line each
/// \throw UsageError  unknown extension, costs that the format cannot hold, a file that cannot be written
std::vector<std::string> write_problem(const std::filesystem::path& path, const ProblemFile& file);
std::vector<std::string> write_problem(const std::filesystem::path& path, const LabelingProblem& problem);

/// \throw UsageError  the extension is none of a format
void require_problem_extension(const std::filesystem::path& path);

}  // namespace toposcope
