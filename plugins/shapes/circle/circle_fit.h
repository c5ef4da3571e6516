// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Estimators of a circle in space. They work in any pose and on any scale: all that they compute with is relative to
// the points' centroid and spread.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/representatives.h"
#include "toposcope/shapes.h"

namespace toposcope::circle {

struct Circle {
  Vec3 center = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit length; its sign means nothing
  double radius = 0;
};

/// How a point lies to a circle: its distance from the circle's cylinder and its height over the circle's plane. The
/// distance from the circle is the length of the two.
struct Offset {
  double radial = 0, height = 0;
  double squared() const { return radial * radial + height * height; }
};
inline Offset offset(const Circle& circle, const Vec3& point) {
  const Vec3 arm = point - circle.center;
  const double height = arm.dot(circle.normal);
  return {(arm - height * circle.normal).norm() - circle.radius, height};
}

/// Of a point from the circle, squared mesh units.
inline double squared_distance(const Circle& circle, const Vec3& point) {
  return offset(circle, point).squared();
}

/// Derivative of (radial, height) by the centre, by a change of the normal along `u` and along `v`, and by the radius.
/// \param u, v  perpendicular to the normal, of any length
inline Eigen::Matrix<double, 2, 6> offset_derivative(const Circle& circle, const Vec3& u, const Vec3& v,
                                                     const Vec3& point) {
  const Vec3 arm = point - circle.center;
  const double height = arm.dot(circle.normal);
  const Vec3 lateral = arm - height * circle.normal;
  const double length = lateral.norm(), inverse = length > 0 ? 1 / length : 0;
  const double along_u = arm.dot(u), along_v = arm.dot(v);
  Eigen::Matrix<double, 2, 6> derivative;
  for (int axis = 0; axis < 3; ++axis) {
    derivative(0, axis) = -inverse * lateral[axis];
    derivative(1, axis) = -circle.normal[axis];
  }
  derivative(0, 3) = -height * inverse * along_u, derivative(1, 3) = along_u;
  derivative(0, 4) = -height * inverse * along_v, derivative(1, 4) = along_v;
  derivative(0, 5) = -1, derivative(1, 5) = 0;
  return derivative;
}

struct Estimate {
  Circle circle;
  FitSummary summary;
};

/// Least quantile of squares over three-point circles, concentrated by closed-form fits (Rousseeuw and Van Driessen
/// 1999; Taubin 1991), then the Geman-McClure distance minimised by Levenberg-Marquardt (Ceres).
/// \param noise_floor   the least noise to assume, mesh unit
/// \param radius_limit  circles above it count as lines
Estimate fit_robust(std::span<const Vec3> points, double noise_floor, double radius_limit);

/// The same from a circle near by, without the search.
Estimate refit(std::span<const Vec3> points, const Circle& start, double noise_floor);

/// Dissertation 4.4.1: least-squares plane, then Powell's method (NLopt's PRAXIS) on centre and radius in that plane.
/// \param box  bb(w), which gives the initial estimate
Estimate fit_powell(std::span<const Vec3> points, const Box& box, double radius_limit);

// ---- what the estimators share ----

/// Says why points with these axes cannot determine a circle, or nothing.
std::string degeneracy(const PrincipalAxes& axes);

/// A usable estimate above the limit becomes a degenerate one.
void check_radius(Estimate& estimate, double radius_limit);

/// The circle of least 65 % quantile of squared distances among many starts, and that quantile; infinite where there
/// is no circle.
struct Start {
  double quantile = 0;
  Circle circle;
};
Start search(std::span<const Vec3> points);

/// Standard deviation of one component of the distances whose 65 % quantile is given, all squared lengths.
double noise_of_quantile(double quantile);

}  // namespace toposcope::circle
