// SPDX-License-Identifier: BSD-3-Clause
#include "base/file_name.h"

#include <algorithm>

#include "base/printable.h"

namespace toposcope {

std::string file_name(std::string_view text) {
  constexpr std::size_t most_bytes = 200;
  std::string name;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = printable_length(text.substr(at));
    const bool plain = length > 0 && std::string_view("/\\:*?\"<>|%#\n\t").find(text[at]) == std::string_view::npos;
    if (name.size() + std::max<std::size_t>(length, 1) > most_bytes) break;
    if (plain)
      name += text.substr(at, length);
    else
      name += '_';
    at += length > 0 ? length : 1;
  }
  if (name.empty()) return "_";
  if (name.front() == '.') name.front() = '_';
  return name;
}

}  // namespace toposcope
