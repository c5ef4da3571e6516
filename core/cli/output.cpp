// SPDX-License-Identifier: BSD-3-Clause
#include "output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/errors.h"
#include "base/printable.h"

namespace toposcope::cli {
namespace {

[[noreturn]] void fail() {
  throw UsageError(std::string("standard output cannot be written (") + std::strerror(errno) +
                   "); is the disk full, or the output closed?");
}

}  // namespace

void write_output(std::string_view text) {
  const std::string shown = printable(text);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size()) fail();
}

void flush_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) fail();
}

void complain(std::string_view message) {
  std::fprintf(stderr, "toposcope: %s\n", shortened(printable(message)).c_str());
}

}  // namespace toposcope::cli
