// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/run_context.h"

namespace toposcope::cli {

/// While it lives, Ctrl-C (SIGINT), SIGTERM and SIGHUP cancel a context, so that whoever works with it can put its
/// temporary files and programs away; else they end the program. One at a time.
class Interruption {
 public:
  explicit Interruption(RunContext& context);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
};

/// Whether a signal has come to an Interruption. A program that we run gets Ctrl-C too, and fails before we look.
bool interrupted();

/// \param undone  what was not done, for the message
/// \throw Error  with the exit code of an interrupted program, if the context was cancelled
void stop_if_cancelled(const Context& context, const std::string& undone);

}  // namespace toposcope::cli
