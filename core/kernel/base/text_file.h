// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace toposcope {

/// The whole of a text file, which must be UTF-8.
/// \param what  for the message: "model", "data set"
/// \throw UsageError  it is no regular file, may not be read, is longer than 1 GiB, or is no UTF-8 ("file:line: ...")
std::string read_text_file(const std::filesystem::path& path, const std::string& what);

}  // namespace toposcope
