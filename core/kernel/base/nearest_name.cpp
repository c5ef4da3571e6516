// SPDX-License-Identifier: BSD-3-Clause
#include "base/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace toposcope {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

/// Restricted Damerau-Levenshtein distance: no letter is edited twice.
std::size_t edit_distance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> before(to.size() + 1), previous(to.size() + 1), current(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replace = previous[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replace});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[to.size()];
}

}  // namespace

std::string nearest_name(std::string_view wrong, const std::vector<std::string>& known) {
  const std::string sought = lower_case(wrong);
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, sought.size() / 3) + 1;
  for (const std::string& name : known) {
    const std::size_t distance = edit_distance(sought, lower_case(name));
    // A name of which no letter is left is not near, however short.
    if (distance < least && distance < name.size()) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string name_remedy(std::string_view wrong, const std::vector<std::string>& known) {
  if (known.empty()) return "there are none";
  const std::string nearest = nearest_name(wrong, known);
  if (!nearest.empty()) return "did you mean '" + nearest + "'?";
  std::string list = "known are: ";
  for (std::size_t i = 0; i < known.size(); ++i) list += (i ? ", " : "") + known[i];
  return list;
}

}  // namespace toposcope
