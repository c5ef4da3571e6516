// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>

#include "convex_hull.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::geometry {

using Eigen::Vector2d;

namespace {

constexpr double straight_tolerance = 1e-12;  ///< of the extent: how far from a side a corner is none

/// Leaves out corners that lie on a side, or that are one, but for rounding.
std::vector<Index> without_straight_corners(std::span<const Vector2d> points, const std::vector<Index>& polygon) {
  double extent = 0;
  for (const Index i : polygon) extent = std::max(extent, (points[i] - points[polygon[0]]).cwiseAbs().maxCoeff());
  const double near = straight_tolerance * extent;
  const auto straight = [&](Index i, Index j, Index k) {
    const Vector2d u = points[j] - points[i], v = points[k] - points[j];
    return u.norm() <= near || (u.dot(v) >= 0 && u.x() * v.y() - u.y() * v.x() <= near * (u + v).norm());
  };
  std::vector<Index> kept;
  for (const Index i : polygon) {
    while (kept.size() >= 2 && straight(kept.end()[-2], kept.back(), i)) kept.pop_back();
    kept.push_back(i);
  }
  while (kept.size() > 2 && straight(kept.end()[-2], kept.back(), kept[0])) kept.pop_back();
  while (kept.size() > 2 && straight(kept.back(), kept[0], kept[1])) kept.erase(kept.begin());
  return kept;
}

}  // namespace

std::vector<Index> convex_polygon(std::span<const Vector2d> points) {
  std::vector<Index> order(points.size()), polygon;
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index i, Index j) {
    const auto &p = points[i], &q = points[j];
    return p.x() != q.x() ? p.x() < q.x() : p.y() != q.y() ? p.y() < q.y() : i < j;
  });
  // Without a tolerance here: it would take corners for points of a side where a side runs along the order.
  const auto turns_left = [&](Index i, Index j, Index k) {
    const Vector2d u = points[j] - points[i], v = points[k] - points[j];
    return u.x() * v.y() - u.y() * v.x() > 0;
  };
  for (int side = 0; side < 2; ++side) {  // lower chain from left to right, upper chain back
    const std::size_t base = polygon.size();
    for (Index i : order) {
      while (polygon.size() >= base + 2 && !turns_left(polygon.end()[-2], polygon.back(), i)) polygon.pop_back();
      polygon.push_back(i);
    }
    polygon.pop_back();  // it begins the other chain
    std::reverse(order.begin(), order.end());
  }
  if (polygon.empty() && !points.empty()) polygon.push_back(order[0]);
  return polygon.size() < 3 ? polygon : without_straight_corners(points, polygon);
}

Vector2d least_rectangle(std::span<const Vector2d> points) {
  const std::vector<Index> polygon = convex_polygon(points);
  const std::size_t count = polygon.size();
  const auto at = [&](std::size_t i) { return points[polygon[i % count]]; };
  const auto edge = [&](std::size_t i) { return Vector2d(at(i + 1) - at(i)); };
  // At most once around: in a polygon that is flat to rounding all sides may seem to rise.
  const auto climb = [&](std::size_t& corner, const Vector2d& direction) {
    for (std::size_t step = 0; step < count && edge(corner).dot(direction) > 0; ++step) ++corner;
  };
  double least = std::numeric_limits<double>::infinity();
  Vector2d best(1, 0);
  for (std::size_t i = 0, right = 0, top = 0, left = 0; i < count && count > 1; ++i) {
    const Vector2d along = edge(i).normalized(), across(-along.y(), along.x());
    // The corners farthest along, across and back only move forward as the edge goes round.
    right = std::max(right, i + 1);
    climb(right, along);
    top = std::max(top, right);
    climb(top, across);
    left = std::max(left, top);
    climb(left, -along);
    const double area = (at(right) - at(left)).dot(along) * (at(top) - at(i)).dot(across);
    if (area < least) {
      least = area;
      best = along;
    }
  }
  return best;
}

}  // namespace toposcope::geometry

namespace toposcope {

std::vector<Index> convex_outline(std::span<const Vec3> points, const Vec3& direction) {
  const Vec3 right = any_perpendicular(direction), up = direction.cross(right).normalized();
  std::vector<Eigen::Vector2d> seen;
  seen.reserve(points.size());
  for (const Vec3& p : points) seen.emplace_back((p - points[0]).dot(right), (p - points[0]).dot(up));
  return geometry::convex_polygon(seen);
}

}  // namespace toposcope
