// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The program as a user runs it, and a folder for what it writes.

#include <filesystem>
#include <string>

namespace toposcope::test {

/// A fresh folder, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path / name; }
  std::filesystem::path path;
};

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// Runs a shell command; -1 when a signal ended it.
Outcome shell(const std::string& command);

/// Runs the program of this build tree.
Outcome toposcope(const std::string& arguments);

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace toposcope::test
