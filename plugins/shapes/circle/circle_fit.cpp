// SPDX-License-Identifier: BSD-3-Clause
#include "circle_fit.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace toposcope::circle {
namespace {

constexpr std::size_t refine_points = 400;  // enough for 0.1 % of the radius under 5 % noise
constexpr int iteration_limit = 200;
constexpr std::size_t search_points = 80;
const double median_to_sd = 1 / std::sqrt(2 * std::log(2.0));  // of the length of two normal components

double squared_distance(const Circle& circle, const Vec3& point) {
  return offset(circle, point).squared();
}

/// Six free parameters about a start: centre, slope of the plane along two axes, radius.
Circle moved(const Circle& start, const Vec3& u, const Vec3& v, const double* x) {
  return {start.center + Vec3(x[0], x[1], x[2]), (start.normal + x[3] * u + x[4] * v).normalized(),
          start.radius + x[5]};
}

/// Two residuals per point, e / sqrt(1 + |e|^2 / c^2): the least squares of them is Geman and McClure's robust sum.
struct RobustResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 6 };

  std::span<const Vec3> points;
  Circle start;
  Vec3 u, v;
  double inverse_width2;  // 1 / c^2

  int NumResiduals() const { return 2 * static_cast<int>(points.size()); }

  bool operator()(const double* x, double* residuals, double* jacobian) const {
    const Circle circle = moved(start, u, v, x);
    const double length = (start.normal + x[3] * u + x[4] * v).norm();
    const Vec3 by_u = (u - circle.normal * circle.normal.dot(u)) / length;
    const Vec3 by_v = (v - circle.normal * circle.normal.dot(v)) / length;
    const std::size_t rows = 2 * points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Offset e = offset(circle, points[i]);
      const double g = 1 / std::sqrt(1 + e.squared() * inverse_width2);
      residuals[2 * i] = g * e.radial;
      residuals[2 * i + 1] = g * e.height;
      if (!jacobian) continue;
      const Eigen::Matrix<double, 2, 6> derivative = offset_derivative(circle, by_u, by_v, points[i]);
      for (std::size_t k = 0; k < 6; ++k) {
        const double radial = derivative(0, k), height = derivative(1, k);
        const double fall = g * g * inverse_width2 * (e.radial * radial + e.height * height);
        jacobian[k * rows + 2 * i] = g * (radial - fall * e.radial);
        jacobian[k * rows + 2 * i + 1] = g * (height - fall * e.height);
      }
    }
    return true;
  }
};

/// Minimises from `circle` until steps fall below `tolerance`; adds to the summary. Unit: the spread of the points.
void minimize(std::span<const Vec3> points, double width, double tolerance, Circle& circle, FitSummary& summary) {
  RobustResiduals residuals{points, circle, any_perpendicular(circle.normal), Vec3::Zero(), 1 / (width * width)};
  residuals.v = circle.normal.cross(residuals.u);
  ceres::TinySolver<RobustResiduals> solver;
  solver.options.max_num_iterations = iteration_limit;
  solver.options.gradient_tolerance = 1e-14;
  solver.options.parameter_tolerance = tolerance;
  // No point costs more than half the width squared; below this, changes of the sum are rounding.
  solver.options.function_tolerance = 1e-16 * static_cast<double>(points.size()) * width * width;
  solver.options.cost_threshold = 1e-28;
  Eigen::Matrix<double, 6, 1> x = Eigen::Matrix<double, 6, 1>::Zero();
  solver.Solve(residuals, &x);
  circle = moved(circle, residuals.u, residuals.v, x.data());
  circle.radius = std::abs(circle.radius);
  summary.termination =
      solver.summary.status == solver.HIT_MAX_ITERATIONS ? Termination::iteration_limit : Termination::converged;
  summary.message =
      summary.usable() ? "converged" : "no convergence in " + std::to_string(iteration_limit) + " iterations";
  summary.iterations += solver.summary.iterations;
  summary.initial_cost = solver.summary.initial_cost;
  summary.final_cost = solver.summary.final_cost;
}

/// Noise (standard deviation of one component) of the points near the circle, at least `floor`.
double noise_of(std::span<const Vec3> points, const Circle& circle, double noise, double floor) {
  std::vector<double> near;
  near.reserve(points.size());
  for (const Vec3& point : points) {
    const double d2 = squared_distance(circle, point);
    if (d2 < 12 * noise * noise) near.push_back(d2);  // 3.5 standard deviations
  }
  if (near.empty()) return noise;
  const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
  std::nth_element(near.begin(), middle, near.end());
  return std::max(std::sqrt(*middle) * median_to_sd, floor);
}

}  // namespace

std::string degeneracy(const PrincipalAxes& axes) {
  const double rounding = 1e-12 * axes.centroid.norm();
  const double spread = std::sqrt(axes.variance[0]);
  if (!(spread > rounding)) return "the points coincide: a circle needs three distinct points";
  if (!(std::sqrt(axes.variance[1]) > std::max(1e-6 * spread, rounding)))
    return "the points lie on one line (or are fewer than three): no circle is determined";
  return {};
}

void check_radius(Estimate& estimate, double radius_limit) {
  if (estimate.summary.usable() && !(estimate.circle.radius <= radius_limit))
    estimate.summary.termination = Termination::degenerate,
    estimate.summary.message = "the points cannot be told from a line: the radius exceeds 100 box diagonals";
}

std::vector<Vec3> representatives(std::span<const Vec3> points, const Vec3& center, std::size_t limit) {
  std::vector<std::pair<double, Index>> ranking(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    ranking[i] = {(points[i] - center).squaredNorm(), static_cast<Index>(i)};
  std::sort(ranking.begin(), ranking.end());
  const std::size_t count = std::min(limit, points.size());
  std::vector<Vec3> chosen(count);
  for (std::size_t k = 0; k < count; ++k) chosen[k] = points[ranking[k * points.size() / count].second];
  return chosen;
}

Offset offset(const Circle& circle, const Vec3& point) {
  const Vec3 arm = point - circle.center;
  const double height = arm.dot(circle.normal);
  return {(arm - height * circle.normal).norm() - circle.radius, height};
}

Eigen::Matrix<double, 2, 6> offset_derivative(const Circle& circle, const Vec3& u, const Vec3& v, const Vec3& point) {
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

Estimate fit_robust(std::span<const Vec3> points, double noise_floor, double radius_limit) {
  Estimate estimate;
  const PrincipalAxes axes = principal_axes(points);
  estimate.summary.message = degeneracy(axes);
  estimate.summary.termination = Termination::degenerate;
  if (!estimate.summary.message.empty()) return estimate;

  const double unit = std::sqrt(axes.variance[0] + axes.variance[1] + axes.variance[2]);
  std::vector<Vec3> sample = representatives(points, axes.centroid, refine_points);
  for (Vec3& point : sample) point = (point - axes.centroid) / unit;
  const double floor = std::max(noise_floor / unit, 1e-6);

  const Start start = search(representatives(sample, Vec3::Zero(), search_points));
  if (!std::isfinite(start.quantile) || start.circle.radius * unit > radius_limit) {
    estimate.summary.message = "the points cannot be told from a line: no circle below 100 box diagonals";
    return estimate;
  }
  Circle circle = start.circle;
  double noise = std::max(noise_of_quantile(start.quantile), floor);
  double initial_cost = 0;
  for (int round = 0; round < 3; ++round) {
    noise = noise_of(sample, circle, noise, floor);
    const double tolerance = round < 2 ? 1e-3 : 1e-9;  // the first rounds only serve to find the noise
    minimize(sample, 2.5 * noise, tolerance, circle, estimate.summary);
    if (round == 0) initial_cost = estimate.summary.initial_cost;
  }
  estimate.circle = {axes.centroid + unit * circle.center, circle.normal, unit * circle.radius};
  estimate.summary.initial_cost = initial_cost * unit * unit;
  estimate.summary.final_cost *= unit * unit;
  check_radius(estimate, radius_limit);
  return estimate;
}

}  // namespace toposcope::circle
