// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// Principal axes of a point set about its centroid.
struct PrincipalAxes {
  Vec3 centroid = Vec3::Zero();                                              ///< mean of the points
  std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};  ///< orthonormal, right-handed
  std::array<double, 3> variance = {0, 0, 0};  ///< mean squared deviation along each axis, descending
};
/// \pre points not empty
PrincipalAxes principal_axes(std::span<const Vec3> points);

/// Oriented box of (nearly) least volume: of the boxes with a face flush with a face of the convex hull, the one of
/// least volume after local descent. Within 0.1 % of the minimum on average and 1 % with rare exceptions
/// (tests hold it against a fine search over rotations); deterministic; equivariant under rotation, translation, scale
/// and vertex order up to rounding. Flat and linear sets get sides of length 0.
Box oriented_box(std::span<const Vec3> points);

/// At least the greatest distance between two points of the boxes: the diagonal of a sphere around all of them.
double enclosing_diameter(std::span<const Box> boxes);

/// A vertex of a point set's convex hull: indices of the extreme points, ascending. Degenerate sets return all
/// points that matter (at least the extremes).
std::vector<Index> hull_vertices(std::span<const Vec3> points);

/// Corners of the convex polygon around the points as they are seen along a direction: indices, counter-clockwise where
/// the direction points at the eye. At most two where the points are seen as a point or a line.
std::vector<Index> convex_outline(std::span<const Vec3> points, const Vec3& direction);

/// Least distance between a point of the one set and a point of the other, in time about proportional to the points.
/// \pre both sets not empty, coordinates finite
double least_distance(std::span<const Vec3> first, std::span<const Vec3> second);

}  // namespace toposcope
