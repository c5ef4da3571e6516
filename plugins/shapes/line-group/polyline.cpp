// SPDX-License-Identifier: BSD-3-Clause
#include "polyline.h"

#include <algorithm>
#include <limits>

namespace toposcope::line_group {

Nearest nearest(const Polyline& polyline, const Vec3& point) {
  Nearest best;
  best.squared = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polyline.segments(); ++k) {
    const Segment segment(polyline.vertices[polyline.tail(k)], polyline.vertices[polyline.head(k)]);
    Nearest at = nearest({&segment, 1}, point);
    at.segment = k;
    if (at.squared < best.squared) best = at;
  }
  return best;
}

double coarse_width(const Problem& problem) {
  return std::max(0.4, 3 * problem.scale);
}

double coarse_gap(const Problem& problem, std::size_t points) {
  const double spacing = 4 / static_cast<double>(points);  // of points along a curve of length 4 spreads
  return 1.5 * std::max(problem.scale, spacing);
}

void trim(Polyline& polyline, std::span<const Vec3> points, double reach) {
  if (polyline.closed) return;
  const std::size_t last = polyline.segments() - 1;
  double first_extent = -std::numeric_limits<double>::infinity(), last_extent = first_extent;
  std::vector<Vec3>& v = polyline.vertices;
  const Vec3 out_first = (v[0] - v[1]).normalized(), out_last = (v[last + 1] - v[last]).normalized();
  for (const Vec3& point : points) {
    const Nearest at = nearest(polyline, point);
    const auto extend = [&](const Vec3& end, const Vec3& out, double& extent) {
      const double along = (point - end).dot(out);
      if ((point - end - along * out).norm() <= reach) extent = std::max(extent, along);
    };
    if (at.segment == 0) extend(v[0], out_first, first_extent);
    if (at.segment == last) extend(v[last + 1], out_last, last_extent);
  }
  // An end does not move past the far end of its segment.
  const double first_length = polyline.length(0), last_length = polyline.length(last);
  if (first_extent > -first_length) v[0] += first_extent * out_first;
  if (last_extent > -last_length) v[last + 1] += last_extent * out_last;
}

void order(Polyline& polyline) {
  std::vector<Vec3>& v = polyline.vertices;
  const std::size_t n = polyline.segments();
  if (!polyline.closed) {
    if (polyline.length(n - 1) > polyline.length(0)) std::reverse(v.begin(), v.end());
    return;
  }
  std::size_t longest = 0;
  for (std::size_t k = 1; k < n; ++k)
    if (polyline.length(k) > polyline.length(longest)) longest = k;
  std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(longest), v.end());
  if (polyline.length(n - 1) > polyline.length(1)) {  // the other way round, the first segment kept
    std::reverse(v.begin(), v.end());
    std::rotate(v.begin(), v.end() - 2, v.end());
  }
}

}  // namespace toposcope::line_group
