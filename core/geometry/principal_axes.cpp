// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "convex_hull.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {

PrincipalAxes principal_axes(std::span<const Vec3> points) {
  PrincipalAxes result;
  const double count = static_cast<double>(points.size());
  // Sums are taken about the first point: far from the origin they would lose what makes up the shape.
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p - points[0];
  const Vec3 mean = sum / count;
  result.centroid = points[0] + mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) {
    const Vec3 d = (p - points[0]) - mean;
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance / count);
  for (int i = 0; i < 3; ++i) {
    result.variance[i] = std::max(0.0, solver.eigenvalues()[2 - i]);
    result.axes[i] = solver.eigenvectors().col(2 - i);
  }
  result.axes[2] = result.axes[0].cross(result.axes[1]);
  return result;
}

}  // namespace toposcope

namespace toposcope::geometry {
namespace {

constexpr double flat_tolerance = 1e-10;  ///< extent / greatest extent

}  // namespace

Vec3 PrincipalFrame::normalized(const Vec3& point) const {
  Vec3 result = Vec3::Zero();
  for (int i = 0; i < dimension; ++i) result[i] = axes[i].dot(point - center) / half[i];
  return result;
}

PrincipalFrame principal_frame(std::span<const Vec3> points) {
  const PrincipalAxes principal = principal_axes(points);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double far_out = 0;
  for (const Vec3& p : points) {
    const Vec3 d = p - principal.centroid;
    const Vec3 local(principal.axes[0].dot(d), principal.axes[1].dot(d), principal.axes[2].dot(d));
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
    far_out = std::max(far_out, p.cwiseAbs().maxCoeff());
  }
  PrincipalFrame frame;
  frame.axes = principal.axes;
  frame.half = (high - low) / 2;
  frame.center = principal.centroid;
  for (int i = 0; i < 3; ++i) frame.center += (low[i] + high[i]) / 2 * frame.axes[i];
  const double noise =
      std::max(flat_tolerance * frame.half.maxCoeff(), 8 * std::numeric_limits<double>::epsilon() * far_out);
  while (frame.dimension < 3 && frame.half[frame.dimension] > noise) ++frame.dimension;
  return frame;
}

}  // namespace toposcope::geometry
