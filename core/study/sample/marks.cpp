// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "sample/solid.h"

namespace toposcope {

TruthFeature circle_feature(const std::string& name, const Vec3& center, const Vec3& normal, double radius,
                            std::size_t count) {
  TruthFeature feature{name, "circle", {}, {}, {}, {}};
  feature.parameters = {{"center", {center.x(), center.y(), center.z()}},
                        {"normal", {normal.x(), normal.y(), normal.z()}},
                        {"radius", {radius}}};
  const Vec3 u = (std::abs(normal.z()) < 0.9 ? normal.cross(Vec3::UnitZ()) : normal.cross(Vec3::UnitX())).normalized();
  const Vec3 v = normal.cross(u);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
    feature.points.push_back(center + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return feature;
}

void mark_vertices(TruthFeature& feature, const std::vector<Vec3>& positions) {
  std::set<Index> taken;
  std::vector<Vec3> points;
  std::vector<Index> renumbered(feature.points.size());
  std::vector<bool> kept(feature.points.size(), false);
  for (std::size_t i = 0; i < feature.points.size(); ++i) {
    const auto distance = [&](const Vec3& p) { return (p - feature.points[i]).squaredNorm(); };
    const auto nearest = std::min_element(positions.begin(), positions.end(),
                                          [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
    const auto vertex = static_cast<Index>(nearest - positions.begin());
    if (!taken.insert(vertex).second) continue;
    kept[i] = true;
    renumbered[i] = static_cast<Index>(points.size());
    points.push_back(feature.points[i]);
    feature.vertices.push_back(vertex);
  }
  feature.points = std::move(points);
  for (TruthGroup& group : feature.groups) {
    std::erase_if(group.members, [&](Index i) { return !kept[i]; });
    for (Index& i : group.members) i = renumbered[i];
  }
}

}  // namespace toposcope
