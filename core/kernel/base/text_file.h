// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace toposcope {

/// The whole of a text file.
/// \param what  for the message: "model", "data set"
/// \throw UsageError  it is no file, or may not be read
std::string read_text_file(const std::filesystem::path& path, const std::string& what);

}  // namespace toposcope
