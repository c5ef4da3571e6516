// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace toposcope {

/// Bytes of the UTF-8 character at the beginning of a text that a terminal shows and does not obey; 0: there is none.
/// A terminal obeys control characters (but for '\n' and '\t'), and those that turn the direction of writing.
std::size_t printable_length(std::string_view text);

/// Bytes before the first that is no UTF-8; the size of the text where all is.
std::size_t utf8_length(std::string_view text);

/// Text from a file as a terminal may have it: characters that it would obey become \u001b, as in JSON, so that JSON
/// stays JSON; bytes that are no UTF-8 become \xff.
std::string printable(std::string_view text);

/// A message of a length that can be read: words of over 200 bytes and lines of over 2,000 keep beginning and end.
std::string shortened(std::string_view message);

}  // namespace toposcope
