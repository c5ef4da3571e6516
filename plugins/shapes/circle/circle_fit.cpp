// SPDX-License-Identifier: BSD-3-Clause
#include "circle_fit.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::circle {
namespace {

constexpr std::size_t refine_points = 400;  // enough for 0.1 % of the radius under 5 % noise
constexpr std::size_t rough_points = 120;   // enough to find the noise
constexpr int iteration_limit = 200;
constexpr std::size_t search_points = 80;
const double median_to_sd = 1 / std::sqrt(2 * std::log(2.0));  // of the length of two normal components

/// Two residuals per point, e / sqrt(1 + |e|^2 / c^2): the least squares of them is Geman and McClure's robust sum. The
/// solver gets seven in their stead, a square root of the normal equations, which is all that it makes of residuals.
class RobustResiduals {
 public:
  using Scalar = double;
  enum { NUM_PARAMETERS = 6, NUM_RESIDUALS = NUM_PARAMETERS + 1 };

  /// \param width  c, at which a point has half of the greatest cost
  RobustResiduals(std::span<const Vec3> points, const Circle& start, double width)
      : points_(points),
        start_(start),
        u_(any_perpendicular(start.normal)),
        v_(start.normal.cross(u_)),
        inverse_width2_(1 / (width * width)) {}

  Circle moved(const double* x) const {
    const Vec3 normal = start_.normal + x[3] * u_ + x[4] * v_;
    return {start_.center + Vec3(x[0], x[1], x[2]), normal.normalized(), start_.radius + x[5]};
  }

  bool operator()(const double* x, double* residuals, double* jacobian) const {
    Eigen::Map<Eigen::Matrix<double, NUM_RESIDUALS, 1>> root(residuals);
    const Circle circle = moved(x);
    if (!jacobian) {  // only their length matters
      double sum = 0;
      for (const Vec3& point : points_) {
        const double squared = squared_distance(circle, point);
        sum += squared / (1 + squared * inverse_width2_);
      }
      root.setZero();
      root[0] = std::sqrt(sum);
      return true;
    }
    const double length = (start_.normal + x[3] * u_ + x[4] * v_).norm();
    const Vec3 by_u = (u_ - circle.normal * circle.normal.dot(u_)) / length;
    const Vec3 by_v = (v_ - circle.normal * circle.normal.dot(v_)) / length;
    Eigen::Matrix<double, 8, 8> sums = Eigen::Matrix<double, 8, 8>::Zero();  // 8: whole vector registers
    Eigen::Matrix<double, 8, 1> radial = Eigen::Matrix<double, 8, 1>::Zero(), height = radial;
    for (const Vec3& point : points_) {
      const Offset e = offset(circle, point);
      const Eigen::Matrix<double, 2, 6> derivative = offset_derivative(circle, by_u, by_v, point);
      radial.head<6>() = derivative.row(0).transpose();
      height.head<6>() = derivative.row(1).transpose();
      radial[6] = height[6] = 0;
      const double g2 = 1 / (1 + e.squared() * inverse_width2_), g = std::sqrt(g2);
      const Eigen::Matrix<double, 8, 1> fall = g2 * inverse_width2_ * (e.radial * radial + e.height * height);
      radial = g * (radial - e.radial * fall);
      height = g * (height - e.height * fall);
      radial[6] = g * e.radial;
      height[6] = g * e.height;
      for (int k = 0; k < NUM_RESIDUALS; ++k) sums.col(k) += radial[k] * radial + height[k] * height;
    }
    using Square = Eigen::Matrix<double, NUM_RESIDUALS, NUM_RESIDUALS>;
    const Eigen::LDLT<Square> factors(sums.topLeftCorner<NUM_RESIDUALS, NUM_RESIDUALS>());
    Square factor = factors.matrixL();
    factor = factor * factors.vectorD().cwiseMax(0).cwiseSqrt().asDiagonal();
    factor = factors.transpositionsP().transpose() * factor;
    Eigen::Map<Eigen::Matrix<double, NUM_RESIDUALS, NUM_PARAMETERS>> derivatives(jacobian);
    derivatives = factor.topRows<NUM_PARAMETERS>().transpose();
    root = factor.row(NUM_PARAMETERS).transpose();
    return true;
  }

 private:
  std::span<const Vec3> points_;
  Circle start_;
  Vec3 u_, v_;  // the normal's free directions
  double inverse_width2_;
};

/// Minimises from `circle` until a step lowers the sum by less than `tolerance` of its greatest possible value; adds to
/// the summary. Unit: the spread of the points.
void minimize(std::span<const Vec3> points, double width, double tolerance, Circle& circle, FitSummary& summary) {
  const RobustResiduals residuals(points, circle, width);
  ceres::TinySolver<RobustResiduals> solver;
  solver.options.max_num_iterations = iteration_limit;
  solver.options.gradient_tolerance = 1e-14;
  solver.options.parameter_tolerance = 1e-9;
  solver.options.function_tolerance = tolerance * static_cast<double>(points.size()) * width * width;
  solver.options.cost_threshold = 1e-28;
  Eigen::Matrix<double, 6, 1> x = Eigen::Matrix<double, 6, 1>::Zero();
  solver.Solve(residuals, &x);
  circle = residuals.moved(x.data());
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
  const std::vector<Vec3> rough = representatives(sample, Vec3::Zero(), rough_points);
  for (int round = 0; round < 2; ++round) {
    noise = noise_of(sample, circle, noise, floor);
    minimize(rough, 2.5 * noise, 1e-6, circle, estimate.summary);
  }
  noise = noise_of(sample, circle, noise, floor);
  minimize(sample, 2.5 * noise, 1e-11, circle, estimate.summary);
  estimate.circle = {axes.centroid + unit * circle.center, circle.normal, unit * circle.radius};
  estimate.summary.initial_cost *= unit * unit;
  estimate.summary.final_cost *= unit * unit;
  check_radius(estimate, radius_limit);
  return estimate;
}

Estimate refit(std::span<const Vec3> points, const Circle& start, double noise_floor) {
  Estimate estimate;
  const double unit = start.radius;
  std::vector<Vec3> sample = representatives(points, start.center, refine_points);
  for (Vec3& point : sample) point = (point - start.center) / unit;
  Circle circle{Vec3::Zero(), start.normal, 1};
  std::vector<double> distances;
  for (const Vec3& point : sample) distances.push_back(squared_distance(circle, point));
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  const double floor = std::max(noise_floor / unit, 1e-6);
  double noise = std::max(std::sqrt(*middle) * median_to_sd, floor);
  for (int round = 0; round < 3; ++round) {
    minimize(sample, 2.5 * noise, round < 2 ? 1e-6 : 1e-11, circle, estimate.summary);
    noise = noise_of(sample, circle, noise, floor);
  }
  estimate.circle = {start.center + unit * circle.center, circle.normal, unit * circle.radius};
  estimate.summary.initial_cost *= unit * unit;
  estimate.summary.final_cost *= unit * unit;
  return estimate;
}

}  // namespace toposcope::circle
