// SPDX-License-Identifier: BSD-3-Clause
#include "base/text_file.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "base/errors.h"
#include "base/printable.h"

namespace toposcope {
namespace {

constexpr std::uintmax_t longest_text = std::uintmax_t{1} << 30;

/// What reads YAML and JSON takes UTF-8 for granted.
void require_utf8(const std::string& text, const std::string& owner) {
  const std::size_t at = utf8_length(text);
  if (at == text.size()) return;
  char byte[8];
  std::snprintf(byte, sizeof byte, "0x%02x", static_cast<unsigned>(static_cast<unsigned char>(text[at])));
  throw UsageError(owner + ":" +
                   std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) +
                   ": the byte " + byte + " is no UTF-8; save the file as UTF-8");
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, const std::string& what) {
  // A folder opens like a file and reads as empty; a pipe or a device may have no end.
  std::error_code ignored;
  const bool regular = std::filesystem::is_regular_file(path, ignored);
  if (const std::uintmax_t size = regular ? std::filesystem::file_size(path, ignored) : 0;
      !ignored && size > longest_text)
    throw UsageError(what + " '" + path.string() + "' has " + std::to_string(size) + " bytes; at most " +
                     std::to_string(longest_text) + " are read, check that it is the right file");
  std::ifstream stream;
  if (regular) stream.open(path, std::ios::binary);
  std::ostringstream text;
  if (stream.is_open()) text << stream.rdbuf();
  if (!stream.is_open() || stream.bad())
    throw UsageError(what + " '" + path.string() + "' cannot be read; check that it is a file and may be read");
  std::string whole = std::move(text).str();
  require_utf8(whole, path.string());
  return whole;
}

}  // namespace toposcope
