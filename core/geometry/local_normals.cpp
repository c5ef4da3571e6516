// SPDX-License-Identifier: BSD-3-Clause
#include "point_tree.h"
#include "revolution.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::revolution {

std::vector<OrientedPoint> local_normals(std::span<const Vec3> queries, std::span<const Vec3> points,
                                         std::size_t count) {
  constexpr double thinnest = 0.02;  // variance across a neighbourhood that is no line, as part of that along it
  const geometry::PointCloud cloud{points};
  const geometry::PointTree tree(cloud);
  std::vector<OrientedPoint> oriented;
  std::vector<Index> indices(count);
  std::vector<double> squared(count);
  std::vector<Vec3> near;
  for (const Vec3& query : queries) {
    const std::size_t found = tree.knnSearch(query.data(), count, indices.data(), squared.data());
    near.clear();
    for (std::size_t i = 0; i < found; ++i) near.push_back(points[indices[i]]);
    const PrincipalAxes axes = principal_axes(near);
    if (axes.variance[1] > thinnest * axes.variance[0]) oriented.push_back({query, axes.axes[2]});
  }
  return oriented;
}

}  // namespace toposcope::revolution
