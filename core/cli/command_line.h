// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>

namespace toposcope::cli {

/// Reads the command line and does what it says. A misspelt command or option is told the nearest that there is; an
/// empty value, which an unset variable of the shell leaves behind, is refused. \param code  what the command sets
/// \return the exit code
int run_command_line(CLI::App& app, int argc, char** argv, const int& code);

}  // namespace toposcope::cli
