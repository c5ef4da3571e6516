// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reading/problem_builder.h"

namespace toposcope {

/// Gives the next parameter of a function, as .wcsp orders them; `what` is for messages.
using NextParameter = std::function<ProblemToken(std::string_view what)>;

/// Adds a function in intension (arithmetic or global) as tables with the same costs for every tuple.
/// \throw UsageError  a keyword that is not supported, parameters that make no sense, a table that would be too large
void add_global_function(ProblemBuilder& builder, const ProblemText& text, const ProblemToken& keyword,
                         const std::string& name, std::vector<Index> scope, const NextParameter& next);

}  // namespace toposcope
