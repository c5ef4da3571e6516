// SPDX-License-Identifier: BSD-3-Clause
// Levenberg-Marquardt of our own: a point touches the two vertices of its segment only, so the normal matrix fills in
// with a few 3 x 3 blocks a point, where a dense solver would spend its time on zeros.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "polyline.h"

namespace toposcope::line_group {
namespace {

constexpr std::size_t screen_points = 100, screened = 16, finalists = 3;
constexpr int final_iterations = 300;
constexpr std::size_t samples_per_segment = 8;  // where a polyline is held against the points
constexpr double piece_weight = 4;              // of the polyline's pieces against the points
constexpr double quantile = 0.65;               // so many points at least belong to the polyline

/// What a descent minimises: per point half the Geman-McClure square of its distance, plus, per piece of polyline, half
/// the square of its distance from the nearest point beyond `gap`. Pieces within the gap are free, so that they draw
/// back segments that run away but do not move those that have their points.
struct Objective {
  std::span<const Vec3> points;
  std::span<const Vec3> anchors;  ///< the points that pieces of the polyline are held against
  double width = 1;               ///< distance beyond which a point counts less and less
  double gap = 0;                 ///< distance from the points that a piece of polyline may have
};

/// Normal equations over the vertices' coordinates.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;

  void reset(std::size_t vertices) {
    matrix.setZero(3 * vertices, 3 * vertices);
    gradient.setZero(3 * vertices);
  }
  /// Adds a residual at the point (1 - t) tail + t head: `slope` its gradient there, `block` its normal matrix.
  void add(std::size_t tail, std::size_t head, double t, const Vec3& slope, const Eigen::Matrix3d& block) {
    const std::size_t at[] = {3 * tail, 3 * head};
    const double share[] = {1 - t, t};
    for (int i = 0; i < 2; ++i) {
      gradient.segment<3>(at[i]) += share[i] * slope;
      for (int j = 0; j < 2; ++j) matrix.block<3, 3>(at[i], at[j]) += share[i] * share[j] * block;
    }
  }
};

/// Cost at a polyline; fills in the normal equations where asked for.
double evaluate(const Objective& objective, const Polyline& polyline, NormalEquations* equations) {
  if (equations) equations->reset(polyline.vertices.size());
  double cost = 0;
  const double forward = 1 / static_cast<double>(objective.points.size());
  for (const Vec3& point : objective.points) {
    const Nearest at = nearest(polyline, point);
    const double fall = 1 + at.squared / (objective.width * objective.width), weight = forward / (fall * fall);
    cost += 0.5 * forward * at.squared / fall;
    if (!equations) continue;
    Eigen::Matrix3d block = weight * Eigen::Matrix3d::Identity();
    const std::size_t tail = polyline.tail(at.segment), head = polyline.head(at.segment);
    if (at.t > 0 && at.t < 1) {  // sliding along the segment costs nothing
      const Vec3 along = (polyline.vertices[head] - polyline.vertices[tail]).normalized();
      block -= weight * along * along.transpose();
    }
    equations->add(tail, head, at.t, -weight * at.difference, block);
  }

  const double pieces = static_cast<double>(polyline.segments() * samples_per_segment);
  const double weight = piece_weight / pieces;
  for (std::size_t k = 0; k < polyline.segments(); ++k)
    for (std::size_t i = 0; i < samples_per_segment; ++i) {
      const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(samples_per_segment);
      const Vec3 piece = (1 - t) * polyline.vertices[polyline.tail(k)] + t * polyline.vertices[polyline.head(k)];
      Vec3 away = Vec3::Zero();
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3& point : objective.anchors) {
        const double d2 = (piece - point).squaredNorm();
        if (d2 < least) least = d2, away = piece - point;
      }
      const double distance = std::sqrt(least), beyond = distance - objective.gap;
      if (beyond <= 0) continue;
      cost += 0.5 * weight * beyond * beyond;
      if (!equations) continue;
      const Vec3 unit = away / distance;
      const double share = beyond / distance;
      const Eigen::Matrix3d block =
          weight * (share * share * Eigen::Matrix3d::Identity() + (1 - share * share) * unit * unit.transpose());
      equations->add(polyline.tail(k), polyline.head(k), t, weight * beyond * unit, block);
    }
  return cost;
}

struct Descent {
  double cost = 0, initial_cost = 0;
  int iterations = 0;
  bool converged = false;
};

/// Damps each vertex alike in all directions, so that the path of a descent turns with the points: among the many close
/// minima that the assignment of points to segments makes, it ends in the same one in every pose.
void damp(double damping, const Eigen::MatrixXd& matrix, Eigen::MatrixXd& damped) {
  damped = matrix;
  const double least = 1e-6 * matrix.trace() / static_cast<double>(matrix.rows());
  for (Eigen::Index i = 0; i < matrix.rows(); i += 3)
    damped.diagonal().segment<3>(i).array() += damping * std::max(matrix.block<3, 3>(i, i).trace() / 3, least);
}

/// Minimises from `polyline` until steps fall below `tolerance` (lengths: the points' spread is 1).
Descent descend(const Objective& objective, int iteration_limit, double tolerance, Polyline& polyline) {
  NormalEquations equations, next_equations;
  Descent descent;
  descent.cost = descent.initial_cost = evaluate(objective, polyline, &equations);
  double damping = 1e-3;
  Polyline next = polyline;
  Eigen::MatrixXd damped;
  for (; descent.iterations < iteration_limit; ++descent.iterations) {
    damp(damping, equations.matrix, damped);
    const Eigen::VectorXd step = damped.ldlt().solve(-equations.gradient);
    for (std::size_t i = 0; i < polyline.vertices.size(); ++i)
      next.vertices[i] = polyline.vertices[i] + step.segment<3>(3 * i);
    const double largest = step.lpNorm<Eigen::Infinity>();
    const double cost = evaluate(objective, next, &next_equations);
    // A step that heavy damping made small proves nothing, unless no step at all leads down.
    descent.converged = std::isfinite(largest) && ((largest <= tolerance && damping < 1) || damping > 1e9);
    if (cost < descent.cost) {
      std::swap(polyline.vertices, next.vertices);
      std::swap(equations, next_equations);
      descent.converged = descent.converged || descent.cost - cost < 1e-12 * cost;
      descent.cost = cost;
      damping = std::max(damping / 5, 1e-6);
    } else {
      damping *= 4;
    }
    if (descent.converged || !std::isfinite(largest)) break;
  }
  return descent;
}

struct Candidate {
  double cost = 0;
  Polyline polyline;
};

void keep_best(std::vector<Candidate>& candidates, std::size_t count) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  candidates.resize(std::min(candidates.size(), count));
}

Objective screening_objective(const Problem& problem, std::span<const Vec3> points) {
  const double spacing = 4 / static_cast<double>(points.size());  // of points along a curve of length 4 spreads
  return {points, points, std::max(0.4, 3 * problem.scale), 1.5 * std::max(problem.scale, spacing)};
}

/// Noise (standard deviation of one component), from a quantile of the distances.
double noise_of(const Polyline& polyline, std::span<const Vec3> points) {
  std::vector<double> squares;
  squares.reserve(points.size());
  for (const Vec3& point : points) squares.push_back(nearest(polyline, point).squared);
  const auto at = squares.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(points.size() - 1));
  std::nth_element(squares.begin(), at, squares.end());
  return std::sqrt(*at / (-2 * std::log(1 - quantile)));
}

}  // namespace

double two_sided_cost(const Problem& problem, const Polyline& polyline) {
  return evaluate(screening_objective(problem, problem.points), polyline, nullptr);
}

Estimate fit_polyline(const Problem& problem) {
  // Coarse points and a wide loss for all starts, all points and a narrow loss for the best.
  const std::vector<Vec3> coarse = representatives(problem.points, Vec3::Zero(), screen_points);
  const Objective screening = screening_objective(problem, coarse);
  std::vector<Candidate> candidates;
  for (Polyline& start : starts(problem)) candidates.push_back({evaluate(screening, start, nullptr), std::move(start)});
  keep_best(candidates, screened);
  for (auto& [cost, polyline] : candidates) cost = descend(screening, 10, 1e-3, polyline).cost;
  keep_best(candidates, finalists);

  const double width = std::max(3 * problem.scale, 2.5 * noise_of(candidates.front().polyline, coarse));
  const Objective narrow{coarse, coarse, width, screening.gap};
  for (auto& [cost, polyline] : candidates) cost = descend(narrow, 20, 1e-4, polyline).cost;
  keep_best(candidates, 1);
  Estimate estimate;
  estimate.polyline = std::move(candidates.front().polyline);
  const Descent descent =
      descend({problem.points, coarse, width, 2 * screening.gap}, final_iterations, 1e-7, estimate.polyline);
  const double count = static_cast<double>(problem.points.size());
  estimate.summary = {
      descent.converged ? Termination::converged : Termination::iteration_limit,
      descent.converged ? "converged" : "no convergence in " + std::to_string(final_iterations) + " iterations",
      descent.iterations, descent.initial_cost * count, descent.cost * count};
  return estimate;
}

}  // namespace toposcope::line_group
