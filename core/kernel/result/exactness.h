// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string>

#include "toposcope/labeling.h"

namespace toposcope {

inline const char* name_of(Exactness exactness) {
  constexpr const char* names[] = {"none", "exact", "bound", "approximate"};
  return names[static_cast<std::size_t>(exactness)];
}

/// "exact", "approximate", "off by at most 0.001 nats"
inline std::string in_words(Exactness exactness, double error, const char* unit = "") {
  return exactness == Exactness::bound ? fmt::format("off by at most {:.3g}{}", error, unit) : name_of(exactness);
}

}  // namespace toposcope
