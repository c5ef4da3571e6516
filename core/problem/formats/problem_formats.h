// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The formats one by one; `where` names the file in messages. Writers of .cfn, .wcsp and .uai:
// toposcope/labeling/problem_writer.h.

#include <string>
#include <string_view>

#include "formats/problem_io.h"

namespace toposcope {

ProblemFile read_problem_json(const std::string& where, std::string_view text,
                              std::uint64_t memory_budget = unlimited_memory);
ProblemFile read_cfn(const std::string& where, std::string_view text, std::uint64_t memory_budget = unlimited_memory);
ProblemFile read_wcsp(const std::string& where, std::string_view text, std::uint64_t memory_budget = unlimited_memory);
ProblemFile read_uai(const std::string& where, std::string_view text, std::uint64_t memory_budget = unlimited_memory);
/// All values of observed variables but the observed ones are forbidden.
/// \param text  content of the .evid file
void read_uai_evidence(LabelingProblem& problem, const std::string& where, std::string_view text);

std::string problem_json(const ProblemFile& file);

}  // namespace toposcope
