// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace toposcope::cli {

/// Text for standard output, such that a terminal shows it and does not obey it (base/printable.h); JSON stays JSON.
/// \throw UsageError  it cannot be written
void write_output(std::string_view text);

/// What was written so far leaves the program. \throw UsageError  it cannot be written
void flush_output();

template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_output(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// A message on standard error, "toposcope: ...", shortened where it is too long to be read.
void complain(std::string_view message);

}  // namespace toposcope::cli
