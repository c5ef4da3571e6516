// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/resolution.h"

#include <array>

namespace toposcope {

std::span<const OptionRow> resolution_option_table() {
  static const std::array<OptionRow, 1> table = {{
      {"faces", OptionType::integer, "", "40000", "0", "100000000",
       "of a mesh of more than twice so many faces a coarse one of about so many is analysed; 0: every mesh itself"},
  }};
  return table;
}

Resolution resolution_of(const Options& options) {
  return {static_cast<std::size_t>(options.integer("faces"))};
}

}  // namespace toposcope
