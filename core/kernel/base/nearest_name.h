// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace toposcope {

/// The known name that the user most likely meant by `wrong`: least Damerau-Levenshtein distance (insert, delete,
/// replace, swap neighbours; case costs nothing), the first of equals; "" when no name is near (more than a third of
/// the letters differ).
std::string nearest_name(std::string_view wrong, const std::vector<std::string>& known);

/// The remedy for an unknown name: "did you mean 'rim'?", or "known are: rim, bottom", or "there are none".
std::string name_remedy(std::string_view wrong, const std::vector<std::string>& known);

}  // namespace toposcope
