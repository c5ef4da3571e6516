// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope::geometry {

/// The axis-aligned frame of a point set's principal axes, with its extents.
struct PrincipalFrame {
  Vec3 center = Vec3::Zero();
  std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  Vec3 half = Vec3::Zero();  ///< half extents along the axes
  int dimension = 0;         ///< 0 a point, 1 a line, 2 flat, 3: extents below rounding do not count

  /// Coordinates from -1 to 1 along every axis that counts, 0 along the others. Convexity survives such a scaling,
  /// and thin sets become as thick as any other.
  Vec3 normalized(const Vec3& point) const;
};
PrincipalFrame principal_frame(std::span<const Vec3> points);

/// Triangles of the convex hull, counter-clockwise seen from outside, by Quickhull (Barber, Dobkin, Huhdanpaa 1996).
/// Points within 1e-10 of a face count as inside, so every vertex of the hull is an extreme point.
/// \param points  normalized; empty result where they lie in a plane
std::vector<Triangle> convex_hull(std::span<const Vec3> points);

/// Corners of the convex polygon around points of the plane, counter-clockwise, as indices (Andrew's monotone chain).
std::vector<Index> convex_polygon(std::span<const Eigen::Vector2d> points);

/// Direction of a side of the rectangle of least area around points of the plane. It lies along a side of their convex
/// polygon (Freeman and Shapira 1975); found by rotating calipers (Toussaint 1983).
Eigen::Vector2d least_rectangle(std::span<const Eigen::Vector2d> points);

}  // namespace toposcope::geometry
