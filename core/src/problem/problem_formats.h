// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The formats one by one; `where` names the file in messages.

#include <string>
#include <string_view>

#include "problem/problem_io.h"

namespace toposcope {

ProblemFile read_problem_json(const std::string& where, std::string_view text);
ProblemFile read_cfn(const std::string& where, std::string_view text);
ProblemFile read_wcsp(const std::string& where, std::string_view text);
/// \param evidence  content of the .evid file, empty: none
ProblemFile read_uai(const std::string& where, std::string_view text, std::string_view evidence);

std::string problem_json(const LabelingProblem& problem);
std::string cfn_text(const LabelingProblem& problem);
std::string wcsp_text(const LabelingProblem& problem);
std::string uai_text(const LabelingProblem& problem);

}  // namespace toposcope
