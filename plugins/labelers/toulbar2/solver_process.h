// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A folder of one's own and a program that runs in it until it ends or is stopped.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace toposcope::toulbar2 {

namespace fs = std::filesystem;

/// Removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void write_text(const fs::path& path, const std::string& text);

std::string read_text(const fs::path& path);

/// Runs a program with its output in a file, and kills it once `stop` says so.
/// \return true when it ended by itself
bool run(const fs::path& program, std::vector<std::string> arguments, const fs::path& output,
         const std::function<bool()>& stop);

}  // namespace toposcope::toulbar2
