// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace ellipse {

using Vec2 = Eigen::Vector2d;
using Mat5 = Eigen::Matrix<double, 5, 5>;

/// In the plane: centre, semi-axes a >= b, angle of the first axis (rad).
struct PlaneEllipse {
  Vec2 center = Vec2::Zero();
  double a = 1, b = 1, angle = 0;

  /// The point at parameter t: center + R(angle) (a cos t, b sin t).
  Vec2 at(double t) const;
  /// In the ellipse's own frame.
  Vec2 local(const Vec2& x) const;
};

/// Parameter of the point of the ellipse nearest to x (Eberly, Distance from a point to an ellipse, 2013: a bisection
/// that always converges).
double nearest(const PlaneEllipse& ellipse, const Vec2& x);

/// Direct least squares on the algebraic distance with the constraint 4ac - b² = 1 (Fitzgibbon, Pilu and Fisher 1999,
/// in the stable form of Halíř and Flusser 1998). Nothing where the points do not determine an ellipse. \pre the
/// points' mean is about 0 and their spread about 1
std::optional<PlaneEllipse> direct_fit(std::span<const Vec2> points);

struct Refined {
  PlaneEllipse ellipse;
  Mat5 normal = Mat5::Zero();  ///< J^T W J at the end: of center, a, b and angle
  double scale = 0;            ///< noise of the points, by their median distance
  int iterations = 0;
  bool converged = false;
};

/// Least orthogonal distances with Tukey's weights by Gauss-Newton, from `start` (Ahn, Least squares orthogonal
/// distance fitting, 2004). \param least_scale  of the weights: points that lie exactly on the ellipse leave it some
/// width
Refined refine(std::span<const Vec2> points, const PlaneEllipse& start, double least_scale);

}  // namespace ellipse
