// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// Any unit vector perpendicular to `direction`.
Vec3 any_perpendicular(const Vec3& direction);

/// Angle between two lines, 0 to pi/2, accurate for small angles (atan2 of cross and dot product).
double line_angle(const Vec3& u, const Vec3& v);

/// Closest point of segment pq to x, and its parameter in [0, 1].
struct SegmentPoint {
  Vec3 point;    ///< on the segment
  double t = 0;  ///< 0 at p, 1 at q
};
SegmentPoint closest_on_segment(const Vec3& p, const Vec3& q, const Vec3& x);

/// Points along the polyline p0 p1 ..., spaced at most `step`, corners included, at most `limit` points.
std::vector<Vec3> resample(std::span<const Vec3> polyline, double step, std::size_t limit = 512);

}  // namespace toposcope
