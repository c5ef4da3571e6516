// SPDX-License-Identifier: BSD-3-Clause
#include "base/text_file.h"

#include <fstream>
#include <sstream>

#include "base/errors.h"

namespace toposcope {

std::string read_text_file(const std::filesystem::path& path, const std::string& what) {
  std::ifstream stream(path, std::ios::binary);
  // A folder opens like a file and reads as empty.
  std::error_code ignored;
  std::ostringstream text;
  if (stream && !std::filesystem::is_directory(path, ignored)) text << stream.rdbuf();
  if (!stream || std::filesystem::is_directory(path, ignored))
    throw UsageError(what + " '" + path.string() + "' cannot be read; check that it is a file and may be read");
  return std::move(text).str();
}

}  // namespace toposcope
