// SPDX-License-Identifier: BSD-3-Clause
#include "io/gltf_uri.h"

#include <algorithm>
#include <system_error>

namespace toposcope {
namespace {

/// The value of a digit, -1 of another character.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// %20 and its like.
std::string without_escapes(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
    result += low >= 0 ? static_cast<char>(16 * high + low) : text[i];
    if (low >= 0) i += 2;
  }
  return result;
}

bool begins_with(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

std::string decode_data_uri(const GltfValue& place, std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == uri.npos || !uri.substr(0, comma).ends_with(";base64"))
    place.fail("is a data URI without ';base64,', which cannot be read; export a .glb");
  std::string_view digits = uri.substr(comma + 1);
  while (digits.ends_with('=')) digits.remove_suffix(1);
  std::string result;
  result.reserve(digits.size() / 4 * 3 + 2);
  unsigned bits = 0;
  int held = 0;
  for (char c : digits) {
    const int digit = base64_digit(c);
    if (digit < 0) place.fail("holds " + quoted({&c, 1}) + ", which is not base64; it is damaged");
    bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffff;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    result += static_cast<char>(bits >> held);
  }
  return result;
}

std::filesystem::path path_of_uri(const GltfValue& place, std::string_view uri, const std::filesystem::path& folder) {
  const std::string text = without_escapes(uri);
  const std::filesystem::path relative = std::filesystem::path(text).lexically_normal();
  const bool has_control = std::ranges::any_of(text, [](char c) { return c >= '\0' && c < ' '; });
  std::error_code error;
  const auto base = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error);
  const auto path = std::filesystem::weakly_canonical(base / relative, error);
  if (error || has_control || text.empty() || text.find(':') != text.npos || relative.is_absolute() ||
      *relative.begin() == ".." || !begins_with(path, base))
    place.fail("names " + toposcope::quoted(text) +
               ", but only files in the glTF's own folder or below it are read; put it there, or export a .glb");
  return base / relative;
}

}  // namespace toposcope
