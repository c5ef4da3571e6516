// SPDX-License-Identifier: BSD-3-Clause
#include "base/printable.h"

#include <cstdint>
#include <cstdio>

namespace toposcope {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: no UTF-8
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 && lead < 0xf5   ? 4
                            : lead >= 0xe0 && lead < 0xf0 ? 3
                            : lead >= 0xc2 && lead < 0xe0 ? 2
                                                          : 0;
  if (bytes == 0 || bytes > text.size()) return {};
  std::uint32_t code = lead & (0xffu >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[bytes] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
  return {code, bytes};
}

bool obeyed(std::uint32_t code) {
  if (code == '\n' || code == '\t') return false;
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x61c || code == 0x200e || code == 0x200f ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

/// Keeps beginning and end of what is longer than `most` bytes, at whole characters.
std::string cut(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  const auto whole = [&](std::size_t at) {
    while (at > 0 && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) --at;
    return at;
  };
  const std::size_t head = whole(most / 2), tail = whole(text.size() - most / 4);
  return std::string(text.substr(0, head)) + "...(" + std::to_string(tail - head) + " bytes)..." +
         std::string(text.substr(tail));
}

/// Each part up to `separator`, cut.
template <class Cut>
std::string each_part(std::string_view text, char separator, const Cut& cut_part) {
  std::string parts;
  for (std::size_t end = text.find(separator); end != text.npos; end = text.find(separator)) {
    parts += cut_part(text.substr(0, end)) + separator;
    text.remove_prefix(end + 1);
  }
  return parts + cut_part(text);
}

}  // namespace

std::size_t printable_length(std::string_view text) {
  if (text.empty()) return 0;
  const Character character = first_character(text);
  return obeyed(character.code) ? 0 : character.bytes;
}

std::size_t utf8_length(std::string_view text) {
  std::size_t at = 0;
  for (std::size_t bytes = 1; at < text.size() && bytes > 0; at += bytes)
    bytes = first_character(text.substr(at)).bytes;
  return at;
}

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_character(text);
    if (character.bytes > 0 && !obeyed(character.code)) {
      shown += text.substr(0, character.bytes);
    } else {
      char escape[12];
      if (character.bytes > 0)
        std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(character.code));
      else
        std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(text[0])));
      shown += escape;
    }
    text.remove_prefix(character.bytes > 0 ? character.bytes : 1);
  }
  return shown;
}

std::string shortened(std::string_view message) {
  constexpr std::size_t longest_word = 200, longest_line = 2000;
  return each_part(message, '\n', [](std::string_view line) {
    return cut(each_part(line, ' ', [](std::string_view word) { return cut(word, longest_word); }), longest_line);
  });
}

}  // namespace toposcope
