// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace toposcope {

/// A step into a JSON document: a key, or the index of an item.
struct JsonStep {
  std::string key;
  std::size_t index = 0;
};

/// "line:column" of the value that a path leads to, in a text that is known to be JSON; of as much of the path as there
/// is. Errors are rare, so the text is walked through again instead of carrying places along.
std::string json_place(std::string_view text, const std::vector<JsonStep>& path);

}  // namespace toposcope
