// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace toposcope {

/// A field of a CSV file, in quotes where it must be (RFC 4180).
inline std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace toposcope
