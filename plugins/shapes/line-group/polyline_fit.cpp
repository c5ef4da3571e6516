// SPDX-License-Identifier: BSD-3-Clause
// Levenberg-Marquardt of our own: a point touches the two vertices of its segment only, so that a segment's points make
// a few 3 x 3 blocks (objective.h), where a dense solver would spend its time on zeros.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "objective.h"

namespace toposcope::line_group {
namespace {

constexpr std::size_t screen_points = 100, finalists = 3;
/// Few steps for many starts, more for the few that these leave ahead.
struct Heat {
  std::size_t starts;
  int iterations;
};
constexpr Heat heats[] = {{16, 3}, {6, 7}};
constexpr int final_iterations = 300;
constexpr double quantile = 0.65;  // so many points at least belong to the polyline

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
Descent descend(Objective& objective, int iteration_limit, double tolerance, Polyline& polyline) {
  NormalEquations equations, next_equations;
  Descent descent;
  descent.cost = descent.initial_cost = objective.evaluate(polyline, &equations);
  double damping = 1e-3;
  Polyline next = polyline;
  Eigen::MatrixXd damped;
  Eigen::VectorXd step;
  Eigen::LLT<Eigen::MatrixXd> solver;
  for (; descent.iterations < iteration_limit; ++descent.iterations) {
    damp(damping, equations.matrix, damped);
    solver.compute(damped);
    step = solver.solve(-equations.gradient);
    for (std::size_t i = 0; i < polyline.vertices.size(); ++i)
      next.vertices[i] = polyline.vertices[i] + step.segment<3>(3 * i);
    const double largest = step.lpNorm<Eigen::Infinity>();
    const double cost = objective.evaluate(next, &next_equations);
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
  return {points, points, coarse_width(problem), coarse_gap(problem, points.size())};
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
  return screening_objective(problem, problem.points).evaluate(polyline);
}

Estimate fit_polyline(const Problem& problem) {
  // Coarse points and a wide loss for all starts, all points and a narrow loss for the best.
  const std::vector<Vec3> coarse = representatives(problem.points, Vec3::Zero(), screen_points);
  Objective screening = screening_objective(problem, coarse);
  std::vector<Candidate> candidates;
  for (Polyline& start : starts(problem)) candidates.push_back({screening.evaluate(start), std::move(start)});
  for (const auto& [count, iterations] : heats) {
    keep_best(candidates, count);
    for (auto& [cost, polyline] : candidates) cost = descend(screening, iterations, 1e-3, polyline).cost;
  }
  keep_best(candidates, finalists);

  const double width = std::max(3 * problem.scale, 2.5 * noise_of(candidates.front().polyline, coarse));
  Objective narrow(coarse, coarse, width, screening.gap());
  for (auto& [cost, polyline] : candidates) cost = descend(narrow, 20, 1e-4, polyline).cost;
  keep_best(candidates, 1);
  Estimate estimate;
  estimate.polyline = std::move(candidates.front().polyline);
  Objective whole(problem.points, coarse, width, 2 * screening.gap());
  const Descent descent = descend(whole, final_iterations, 1e-7, estimate.polyline);
  const double count = static_cast<double>(problem.points.size());
  estimate.summary = {
      descent.converged ? Termination::converged : Termination::iteration_limit,
      descent.converged ? "converged" : "no convergence in " + std::to_string(final_iterations) + " iterations",
      descent.iterations, descent.initial_cost * count, descent.cost * count};
  return estimate;
}

}  // namespace toposcope::line_group
