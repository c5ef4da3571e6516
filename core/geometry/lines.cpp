// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace toposcope {

Vec3 any_perpendicular(const Vec3& direction) {
  // Crossing with the axis farthest from the direction keeps the product well away from zero.
  Eigen::Index least = 0;
  direction.cwiseAbs().minCoeff(&least);
  return direction.cross(Vec3::Unit(least)).stableNormalized();
}

double line_angle(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), std::abs(u.dot(v)));
}

SegmentPoint closest_on_segment(const Vec3& p, const Vec3& q, const Vec3& x) {
  const Vec3 along = q - p;
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((x - p).dot(along) / squared, 0.0, 1.0) : 0.0;
  return {p + t * along, t};
}

std::vector<Vec3> resample(std::span<const Vec3> polyline, double step, std::size_t limit) {
  std::vector<Vec3> points;
  if (polyline.empty() || limit == 0) return points;
  const std::size_t segments = polyline.size() - 1;
  double length = 0;
  for (std::size_t i = 0; i < segments; ++i) length += (polyline[i + 1] - polyline[i]).norm();
  // Each segment is cut into ceil(length / step) pieces: at most length / step + segments in all.
  if (limit > polyline.size()) step = std::max(step, length / static_cast<double>(limit - polyline.size()));
  points.push_back(polyline[0]);
  for (std::size_t i = 0; i < segments && points.size() < limit; ++i) {
    const Vec3 along = polyline[i + 1] - polyline[i];
    const double wanted = limit > polyline.size() && step > 0 ? std::ceil(along.norm() / step) : 1;
    const auto pieces = static_cast<std::size_t>(std::max(wanted, 1.0));
    for (std::size_t k = 1; k < pieces && points.size() < limit; ++k)
      points.push_back(polyline[i] + along * (static_cast<double>(k) / static_cast<double>(pieces)));
    if (points.size() < limit) points.push_back(polyline[i + 1]);
  }
  return points;
}

}  // namespace toposcope
