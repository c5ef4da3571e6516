// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "verdict.h"

namespace toposcope {

struct Examination {
  bool brief = false;      ///< only what shows errors of memory, every input once: for a run under a memory checker
  double patience_s = 10;  ///< how long a cancelled plugin may go on: a machine may be busy
};

/// The conformance kit: holds one plugin against what every plugin of its kind owes (docs/guide/plugins.md lists the
/// checks). Runs the plugin's code in this process: what it breaks is broken here. The program starts a process for
/// each plugin.
/// \param library  the manifest is beside it
void examine_plugin(const std::filesystem::path& library, const Examination& examination, VerdictSink& sink);

}  // namespace toposcope
