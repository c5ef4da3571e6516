// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trial.h"

namespace toposcope {

/// The points of a feature's working sets, as shapes are fitted to.
struct PointSets {
  std::string name;
  std::vector<Vec3> points;
  double mean_edge = 0.05;
  std::vector<Index> offsets;  ///< as FitInput's: size sets + 1
};

/// Rings, strips, patches and caps with a little noise, cut into `sets` working sets along their length.
std::vector<PointSets> ordinary_points(std::size_t sets);
/// No point, few points, points on a line or at one place, points of huge and of tiny extent.
std::vector<PointSets> degenerate_points(std::size_t sets);

/// Moved; shuffled within each set.
PointSets moved(const PointSets& points, const Motion& motion);

}  // namespace toposcope
