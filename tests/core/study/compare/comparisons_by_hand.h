// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "compare/comparison.h"

namespace toposcope::test {

/// Two labelers on two meshes: on the first they differ, on the second the quick one's labelling breaks a constraint.
inline std::vector<Comparison> comparisons_by_hand() {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto entry = [](const char* labeler, Index rim, Index handle) {
    Entry made;
    made.labeler = labeler;
    made.class_name = "cup";
    made.labeling = {{"rim", rim}, {"handle", handle}};
    made.right = 1;
    made.of = 2;
    made.posterior = none;
    made.time_ms = 1;
    return made;
  };
  const auto exact = [&](Index rim, Index handle, double cost) {
    Entry made = entry("exact", rim, handle);
    made.cost = made.bound = cost;
    made.proven = true;
    made.guarantee = "optimal";
    return made;
  };
  Entry first = exact(3, 0, 1.5), second = exact(1, 2, 4);
  first.posterior = 0.5;
  first.right = 2;
  first.time_ms = 2;
  first.nodes = 10;
  second.time_ms = 4;
  second.nodes = 20;
  Entry worse = entry("quick:sweeps=a,b", 0, 0), unsound = entry("quick:sweeps=a,b", 1, 2);
  worse.cost = 3.5;
  worse.bound = 1.5;
  unsound.cost = infinite;
  unsound.bound = 4;
  return {{"a.ply", {first, worse}}, {"meshes/b.ply", {second, unsound}}};
}

}  // namespace toposcope::test
