// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace toposcope {

/// Makes a folder of a name of its own, toposcope-NAME-..., where TMPDIR says; whoever asks removes it.
/// \throw std::system_error  it cannot be made: names the folder and the remedy
inline std::string temporary_folder(const std::string& name) {
  const auto refuse = [](const std::string& folder, std::error_code error) {
    throw std::system_error(error,
                            "the folder " + folder + " cannot be made; set TMPDIR to a folder that may be written");
  };
  std::error_code error;
  const std::filesystem::path base = std::filesystem::temp_directory_path(error);
  const char* given = std::getenv("TMPDIR");
  if (error) refuse(given ? given : "/tmp", error);
  std::string folder = (base / ("toposcope-" + name + "-XXXXXX")).string();
  if (!mkdtemp(folder.data())) refuse(folder, {errno, std::generic_category()});
  return folder;
}

}  // namespace toposcope
