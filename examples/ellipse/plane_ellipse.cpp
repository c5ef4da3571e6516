// SPDX-License-Identifier: BSD-3-Clause
#include "plane_ellipse.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ellipse {
namespace {

constexpr int iteration_limit = 100;

/// Centre, axes and angle of a x² + b xy + c y² + d x + e y + f = 0; nothing where it is no ellipse.
std::optional<PlaneEllipse> from_conic(const Eigen::Vector<double, 6>& conic) {
  Eigen::Matrix2d quadratic;
  quadratic << conic[0], conic[1] / 2, conic[1] / 2, conic[2];
  const Vec2 linear(conic[3], conic[4]);
  if (!(quadratic.determinant() > 0)) return std::nullopt;
  PlaneEllipse ellipse;
  ellipse.center = -0.5 * quadratic.inverse() * linear;
  const double value = conic[5] + 0.5 * linear.dot(ellipse.center);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(quadratic);
  const Vec2 squares = -value * solver.eigenvalues().cwiseInverse();
  if (!(squares.minCoeff() > 0) || !squares.allFinite()) return std::nullopt;
  const int major = squares[0] >= squares[1] ? 0 : 1;
  ellipse.a = std::sqrt(squares[major]);
  ellipse.b = std::sqrt(squares[1 - major]);
  ellipse.angle = std::atan2(solver.eigenvectors()(1, major), solver.eigenvectors()(0, major));
  return ellipse;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Vec2 PlaneEllipse::at(double t) const {
  const double c = std::cos(angle), s = std::sin(angle), x = a * std::cos(t), y = b * std::sin(t);
  return center + Vec2(c * x - s * y, s * x + c * y);
}

Vec2 PlaneEllipse::local(const Vec2& x) const {
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec2 d = x - center;
  return {c * d.x() + s * d.y(), -s * d.x() + c * d.y()};
}

double nearest(const PlaneEllipse& ellipse, const Vec2& x) {
  const Vec2 p = ellipse.local(x);
  const double u = std::abs(p.x()) / ellipse.b, v = std::abs(p.y()) / ellipse.b, r = ellipse.a / ellipse.b;
  // The foot is (r² u / (h + r² - 1), v / h) with h the greatest root of F(h) = (r u / (h + r² - 1))² + (v / h)² - 1.
  double low = v, high = std::hypot(r * u, v);
  for (int i = 0; i < 2000; ++i) {
    const double h = (low + high) / 2;
    if (h == low || h == high) break;
    (std::pow(r * u / (h + r * r - 1), 2) + std::pow(v / h, 2) > 1 ? low : high) = h;
  }
  double cosine = r * u / (high + r * r - 1), sine = high > 0 ? v / high : 0;
  // On the major axis between the centres of curvature the foot is above or below.
  if (v == 0 && r * u < r * r - 1) cosine = r * u / (r * r - 1), sine = std::sqrt(1 - cosine * cosine);
  return std::atan2(std::copysign(sine, p.y()), std::copysign(cosine, p.x()));
}

std::optional<PlaneEllipse> direct_fit(std::span<const Vec2> points) {
  Eigen::Matrix3d s1 = Eigen::Matrix3d::Zero(), s2 = s1, s3 = s1;
  const auto count = static_cast<double>(points.size());
  for (const Vec2& p : points) {
    const Eigen::Vector3d quadratic(p.x() * p.x(), p.x() * p.y(), p.y() * p.y()), linear(p.x(), p.y(), 1);
    s1 += quadratic * quadratic.transpose() / count;
    s2 += quadratic * linear.transpose() / count;
    s3 += linear * linear.transpose() / count;
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(s3);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Matrix3d t = -solver.solve(s2.transpose());
  const Eigen::Matrix3d m = s1 + s2 * t;
  Eigen::Matrix3d reduced;
  reduced.row(0) = m.row(2) / 2;
  reduced.row(1) = -m.row(1);
  reduced.row(2) = m.row(0) / 2;
  const Eigen::EigenSolver<Eigen::Matrix3d> eigen(reduced);
  if (eigen.info() != Eigen::Success) return std::nullopt;
  const Eigen::Matrix3d vectors = eigen.eigenvectors().real();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d quadratic = vectors.col(k);
    if (!(4 * quadratic[0] * quadratic[2] - quadratic[1] * quadratic[1] > 0)) continue;
    Eigen::Vector<double, 6> conic;
    conic << quadratic, t * quadratic;
    return from_conic(conic);
  }
  return std::nullopt;
}

Refined refine(std::span<const Vec2> points, const PlaneEllipse& start, double least_scale) {
  Refined result;
  result.ellipse = start;
  std::vector<double> residuals(points.size()), magnitudes(points.size());
  for (result.iterations = 1; result.iterations <= iteration_limit && !result.converged; ++result.iterations) {
    PlaneEllipse& ellipse = result.ellipse;
    std::vector<Eigen::Vector<double, 5>> rows(points.size());
    const double c = std::cos(ellipse.angle), s = std::sin(ellipse.angle);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double t = nearest(ellipse, points[i]);
      // The outward normal at the foot, and how the foot moves along it with each parameter.
      Vec2 normal(ellipse.b * std::cos(t), ellipse.a * std::sin(t));
      normal.normalize();
      normal = Vec2(c * normal.x() - s * normal.y(), s * normal.x() + c * normal.y());
      const Vec2 foot = ellipse.at(t), arm = foot - ellipse.center;
      residuals[i] = (points[i] - foot).dot(normal);
      rows[i] << normal.x(), normal.y(), std::cos(t) * Vec2(c, s).dot(normal), std::sin(t) * Vec2(-s, c).dot(normal),
          Vec2(-arm.y(), arm.x()).dot(normal);
      magnitudes[i] = std::abs(residuals[i]);
    }
    const double scale = std::max(1.4826 * median(magnitudes), least_scale);
    result.scale = result.iterations == 1 ? scale : std::min(result.scale, scale);  // so that it cannot go in circles
    const double width = 4.685 * result.scale;
    result.normal.setZero();
    Eigen::Vector<double, 5> right = Eigen::Vector<double, 5>::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double rest = std::max(0.0, 1 - std::pow(residuals[i] / width, 2));
      result.normal += rest * rest * rows[i] * rows[i].transpose();
      right += rest * rest * residuals[i] * rows[i];
    }
    // The angle of a circle is free: a touch of damping leaves it where it is.
    const Mat5 damped = result.normal + 1e-9 * result.normal.trace() * Mat5::Identity();
    const Eigen::Vector<double, 5> step = damped.ldlt().solve(right);
    if (!step.allFinite()) return result;
    const double shorten = std::min(1.0, 0.5 * ellipse.b / std::max({std::abs(step[2]), std::abs(step[3]), 1e-300}));
    ellipse.center += shorten * step.head<2>();
    ellipse.a += shorten * step[2];
    ellipse.b += shorten * step[3];
    ellipse.angle += shorten * step[4];
    if (ellipse.b > ellipse.a) {
      std::swap(ellipse.a, ellipse.b);
      ellipse.angle += 1.57079632679489661923;
    }
    if (!(ellipse.b > 1e-6 * ellipse.a)) return result;
    const double angular = step[4] * (ellipse.a - ellipse.b);  // what turning it moves
    result.converged =
        shorten == 1 && step.head<4>().norm() + std::abs(angular) < 1e-9 * ellipse.a + 1e-6 * result.scale;
  }
  return result;
}

}  // namespace ellipse
