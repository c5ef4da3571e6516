// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "reading/problem_file.h"

namespace toposcope {

inline constexpr std::uint64_t unlimited_memory = std::numeric_limits<std::uint64_t>::max();

/// Reads .json (schemas/problem.schema.json), toulbar2's .cfn and .wcsp, and .uai with its evidence in <file>.evid.
/// Variables of the last three may not be missing. The locale plays no role.
/// \param memory_budget  bytes that a run may take; a quarter is for all tables together
/// \throw UsageError  with file, line, value, constraint and remedy; also for functions that are not supported
ProblemFile read_problem(const std::filesystem::path& path, std::uint64_t memory_budget = unlimited_memory);

/// Writes the format that the extension names, whole or not at all. .json loses nothing; .cfn and .wcsp have exclusions
/// as pairwise functions and costs as decimals; .uai has factors exp(-cost).
/// \return what the format could not keep, one line each
/// \throw UsageError  unknown extension, costs that the format cannot hold, a file that cannot be written
std::vector<std::string> write_problem(const std::filesystem::path& path, const ProblemFile& file);
std::vector<std::string> write_problem(const std::filesystem::path& path, const LabelingProblem& problem);

/// \throw UsageError  the extension is none of a format
void require_problem_extension(const std::filesystem::path& path);

}  // namespace toposcope
