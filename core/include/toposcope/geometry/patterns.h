// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Points in a regular pattern: on a circle, as the holes of a flange, or in a row. Lengths in the unit of the points.

#include <optional>
#include <span>

#include "toposcope/relations.h"

namespace toposcope {

/// A circle through points in space.
struct PointCircle {
  Vec3 center = Vec3::Zero();   ///< of the circle
  Vec3 normal = Vec3::UnitZ();  ///< of its plane, unit length
  double radius = 0;            ///< of the circle
  double rms = 0;               ///< root mean square distance of the points from their places
};

/// The regular polygon of least squares: its corners, in the order of their angles, are the points' places. For that
/// order it is closed-form, the first harmonic of the points in their plane.
/// \return nothing for fewer than 3 points, or points on one line
std::optional<PointCircle> regular_polygon(std::span<const Vec3> points);

/// The circle of least squares in the points' plane, at any spacing. \return as above
std::optional<PointCircle> point_circle(std::span<const Vec3> points);

/// Points on a straight line.
struct PointRow {
  Vec3 begin = Vec3::Zero();       ///< place of the first
  Vec3 direction = Vec3::UnitX();  ///< unit length
  double spacing = 0;              ///< mean distance of neighbours
  double rms = 0;                  ///< root mean square distance of the points from their places
};

/// The line of least squares, and on it places that are equally far from each other, or, unless `equal`, the points'
/// own. \return nothing for fewer than 3 points, or points in one place
std::optional<PointRow> point_row(std::span<const Vec3> points, bool equal);

/// Fills in what a pattern's relation tells the kernel but for the tolerance.
/// \param rms      how far the features are from their places
/// \param freedom  numbers that a pattern of so many features has
/// \param excess   by how much its radius or spacing lies beyond the model's range
void measure_pattern(RelationResult& result, const RelationInput& input, double rms, int freedom, double excess);

}  // namespace toposcope
