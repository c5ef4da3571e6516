// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toposcope/context.h"
#include "verdict.h"

namespace toposcope::cli {

/// Runs the conformance kit on one plugin in a process of its own, so that a crash is a verdict and not the end. What
/// it started ends with it, and what it left in the folder of temporary files is removed.
/// \param context  asked whether to stop \throw Error  interrupted
std::vector<CheckVerdict> examine_in_process(const std::filesystem::path& library, const Context& context);

/// The same inputs once more under valgrind, in one process, which starts slowly; where that finds something, each
/// plugin in one of its own. \return for each library its verdict "memory"; skipped where valgrind is not installed
std::vector<CheckVerdict> examine_memory(const std::vector<std::filesystem::path>& libraries, const Context& context);

/// The other end: examines in this process and reports to file descriptor 3. \return the exit code
int examine_here(const std::vector<std::filesystem::path>& libraries, bool brief);

}  // namespace toposcope::cli
