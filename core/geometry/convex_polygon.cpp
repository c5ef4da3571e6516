// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <numeric>

#include "convex_hull.h"

namespace toposcope::geometry {

using Eigen::Vector2d;

std::vector<Index> convex_polygon(std::span<const Vector2d> points) {
  std::vector<Index> order(points.size()), polygon;
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index i, Index j) {
    const auto &p = points[i], &q = points[j];
    return p.x() != q.x() ? p.x() < q.x() : p.y() != q.y() ? p.y() < q.y() : i < j;
  });
  // Without a tolerance: it would take corners for points of a side where a side runs along the order.
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
  return polygon;
}

Rectangle least_rectangle_of(std::span<const Vector2d> polygon) {
  const std::size_t count = polygon.size();
  const auto next = [&](std::size_t i) { return i + 1 == count ? 0 : i + 1; };
  const auto edge = [&](std::size_t i) { return Vector2d(polygon[next(i)] - polygon[i]); };
  // At most once around: in a polygon that is flat to rounding all sides may seem to rise.
  const auto climb = [&](std::size_t& corner, const Vector2d& direction) {
    for (std::size_t step = 0; step < count && edge(corner).dot(direction) > 0; ++step) corner = next(corner);
  };
  Rectangle least;
  // The corners farthest along, across and back only move forward as the side goes round.
  for (std::size_t i = 0, right = 0, top = 0, left = 0; i < count && count > 1; ++i) {
    const Vector2d along = edge(i).normalized(), across(-along.y(), along.x());
    if (i == 0) right = 1;
    climb(right, along);
    if (i == 0) top = right;
    climb(top, across);
    if (i == 0) left = top;
    climb(left, -along);
    const double area = (polygon[right] - polygon[left]).dot(along) * (polygon[top] - polygon[i]).dot(across);
    if (area < least.area) least = {along, area};
  }
  return least;
}

Rectangle least_rectangle(std::span<const Vector2d> points) {
  std::vector<Vector2d> corners;
  for (const Index i : convex_polygon(points)) corners.push_back(points[i]);
  return least_rectangle_of(corners);
}

}  // namespace toposcope::geometry
