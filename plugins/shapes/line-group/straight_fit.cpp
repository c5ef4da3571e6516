// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "polyline.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::line_group {
namespace {

constexpr double quantile = 0.65;  // so many points at least belong to the line
constexpr int iteration_limit = 200;

struct Line {
  Vec3 point, direction;
};

double squared_distance(const Line& line, const Vec3& point) {
  return (point - line.point).cross(line.direction).squaredNorm();
}

double quantile_of(const Line& line, std::span<const Vec3> points, std::vector<double>& scratch) {
  scratch.clear();
  for (const Vec3& point : points) scratch.push_back(squared_distance(line, point));
  const auto at = scratch.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(points.size() - 1));
  std::nth_element(scratch.begin(), at, scratch.end());
  return *at;
}

/// The best of the lines through all pairs of some points: one pair in two is good at 30 % outliers.
Line search(std::span<const Vec3> points, std::size_t search_points, Line best, double& best_value) {
  const std::vector<Vec3> sample = representatives(points, Vec3::Zero(), 100);
  const std::vector<Vec3> ends = representatives(points, Vec3::Zero(), search_points);
  std::vector<double> scratch;
  scratch.reserve(sample.size());
  best_value = quantile_of(best, sample, scratch);
  for (std::size_t a = 0; a < ends.size(); ++a)
    for (std::size_t b = a + 1; b < ends.size(); ++b) {
      const double length = (ends[b] - ends[a]).norm();
      if (length < 0.1) continue;  // of the spread: a short base says little of the direction
      const Line line{ends[a], (ends[b] - ends[a]) / length};
      const double value = quantile_of(line, sample, scratch);
      if (value < best_value) best_value = value, best = line;
    }
  return best;
}

/// One step of total least squares with weights (1 + d^2 / c^2)^-2; returns half the robust sum of squares before it.
double reweight(std::span<const Vec3> points, double width, Line& line) {
  double cost = 0, sum = 0;
  Vec3 mean = Vec3::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vec3& point : points) {
    const double d2 = squared_distance(line, point), fall = 1 + d2 / (width * width), weight = 1 / (fall * fall);
    cost += d2 / fall / 2;
    sum += weight;
    mean += weight * point;
    scatter += weight * point * point.transpose();
  }
  mean /= sum;
  scatter = scatter / sum - mean * mean.transpose();
  line = {mean, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(2)};
  return cost;
}

}  // namespace

Estimate fit_straight(const Problem& problem, bool robust, std::size_t search_points) {
  const PrincipalAxes axes = principal_axes(problem.points);
  Line line{axes.centroid, axes.axes[0]};
  Estimate estimate;
  estimate.summary = {Termination::closed_form, "total least squares in closed form", 0, 0, 0};
  const double cost = 0.5 * (axes.variance[1] + axes.variance[2]) * static_cast<double>(problem.points.size());
  estimate.summary.initial_cost = estimate.summary.final_cost = cost;
  if (robust) {
    double value = 0;
    line = search(problem.points, search_points, line, value);
    const double noise = std::sqrt(value / (-2 * std::log(1 - quantile)));  // Rayleigh's quantile
    const double width = std::max(2.5 * noise, 0.1 * problem.scale);
    estimate.summary.termination = Termination::iteration_limit;
    estimate.summary.message = "no convergence in " + std::to_string(iteration_limit) + " iterations";
    for (int i = 1; i <= iteration_limit; ++i) {
      const Line before = line;
      const double now = reweight(problem.points, width, line);
      if (i == 1) estimate.summary.initial_cost = now;
      estimate.summary.final_cost = now;
      estimate.summary.iterations = i;
      const double turn = before.direction.cross(line.direction).norm();
      const double shift = (line.point - before.point).cross(line.direction).norm();
      if (turn + shift < 1e-11) {
        estimate.summary.termination = Termination::converged;
        estimate.summary.message = "converged";
        break;
      }
    }
  }
  estimate.polyline.vertices = {line.point - line.direction, line.point + line.direction};
  return estimate;
}

}  // namespace toposcope::line_group
