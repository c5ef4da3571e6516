// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/spread_directions.h"

#include <cmath>

namespace toposcope {

std::vector<Vec3> spread_directions(std::size_t count) {
  std::vector<Vec3> directions;
  const double golden = pi * (3 - std::sqrt(5.0));
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double radius = std::sqrt(1 - z * z), angle = golden * static_cast<double>(i);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}

}  // namespace toposcope
