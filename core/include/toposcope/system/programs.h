// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

namespace toposcope {

/// The file that a program's name stands for: the first of that name in the folders of PATH that may be run; never one
/// of the working directory.
inline std::optional<std::filesystem::path> find_program(std::string_view name) {
  const char* value = std::getenv("PATH");
  std::string_view folders = value ? value : "/usr/local/bin:/usr/bin:/bin";
  while (!folders.empty()) {
    const std::filesystem::path folder = folders.substr(0, folders.find(':'));
    folders.remove_prefix(std::min(folders.size(), folder.native().size() + 1));
    std::error_code error;
    if (const auto file = folder / name;
        folder.is_absolute() && std::filesystem::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0)
      return file;
  }
  return std::nullopt;
}

}  // namespace toposcope
