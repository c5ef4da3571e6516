// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace toposcope {

/// Whether text begins with the byte order mark of UTF-16, of either order.
bool has_utf16_mark(std::string_view bytes);

/// The text in UTF-8, without its mark. What is no character (a half of a pair, an odd last byte) becomes U+FFFD.
/// \pre has_utf16_mark(bytes)
std::string utf8_of_utf16(std::string_view bytes);

}  // namespace toposcope
