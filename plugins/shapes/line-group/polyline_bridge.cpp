// SPDX-License-Identifier: BSD-3-Clause
// Two straight sets and a segment between them that needs no points, as where a T-tail hides the tip of its fin.

#include <cmath>

#include "polyline.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::line_group {
namespace {

constexpr std::size_t search_points = 8;  // there are many pairs of sets

/// The line of one set, as far as its points go; none where they coincide.
Polyline straight(std::span<const Vec3> points, double scale) {
  const PrincipalAxes axes = principal_axes(points);
  const double unit = std::sqrt(axes.variance[0] + axes.variance[1] + axes.variance[2]);
  if (!(unit > 1e-12 * axes.centroid.norm())) return {};
  Problem problem{representatives(points, axes.centroid, fit_points), {}, scale / unit, 1, false};
  for (Vec3& point : problem.points) point = (point - axes.centroid) / unit;
  Polyline line = fit_straight(problem, true, search_points).polyline;
  for (Vec3& vertex : line.vertices) vertex = axes.centroid + unit * vertex;
  trim(line, points, 2 * scale);
  return line;
}

/// Joins the nearest ends.
Polyline shortest_bridge(const Polyline& one, const Polyline& other) {
  Polyline best;
  if (one.vertices.empty() || other.vertices.empty()) return best;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const Polyline joined{{one.vertices[1 - i], one.vertices[i], other.vertices[j], other.vertices[1 - j]}, false};
      if (best.vertices.empty() || joined.length(1) < best.length(1)) best = joined;
    }
  return best;
}

}  // namespace

void consider_bridge(const Problem& problem, std::span<const Vec3> first, std::span<const Vec3> second,
                     Polyline& polyline) {
  Polyline bridge = shortest_bridge(straight(first, problem.scale), straight(second, problem.scale));
  if (bridge.vertices.empty()) return;
  const double width = coarse_width(problem);
  double cost = 0;
  for (const Vec3& point : problem.points) {
    const double squared = nearest(bridge, point).squared;
    cost += 0.5 * squared / (1 + squared / (width * width));
  }
  cost /= static_cast<double>(problem.points.size());
  if (2 * cost < two_sided_cost(problem, polyline)) polyline = std::move(bridge);
}

}  // namespace toposcope::line_group
