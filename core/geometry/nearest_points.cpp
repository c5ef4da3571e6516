// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "point_tree.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {

double least_distance(std::span<const Vec3> first, std::span<const Vec3> second) {
  if (first.size() > second.size()) std::swap(first, second);
  const geometry::PointCloud cloud{first};
  const geometry::PointTree tree(cloud);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& point : second) {
    Index index = 0;
    double squared = 0;
    nanoflann::KNNResultSet<double, Index> nearest(1);
    nearest.init(&index, &squared);
    squared = least;  // whatever is farther away than the best so far is not looked at
    tree.findNeighbors(nearest, point.data(), nanoflann::SearchParams());
    least = std::min(least, squared);
  }
  return std::sqrt(least);
}

}  // namespace toposcope
