// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mesh/repair.h"

namespace toposcope {

/// One count of a report: its name in JSON, and what it says to a reader.
struct RepairCount {
  const char* name;
  const char* words;  ///< after the number
  Index count;
};

/// What was done, in the order in which it is done; zeros too, but for near vertices, which are rare.
std::vector<RepairCount> repair_counts(const RepairReport& report);

/// "2 edges split, 4 vertices merged"; "nothing to repair".
std::string repair_in_words(const RepairReport& report);

}  // namespace toposcope
