// SPDX-License-Identifier: BSD-3-Clause
// Finds the surface: robust starts, then Levenberg-Marquardt on distances that count less the larger they are.

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "revolution.h"
#include "toposcope/geometry/representatives.h"
#include "toposcope/system/random.h"

namespace toposcope::revolution {
namespace {

constexpr std::size_t search_points = 100, compare_points = 400, refine_points = 2000;
constexpr std::size_t neighbours = 12;
constexpr int random_starts = 200;
constexpr std::size_t refined_starts = 6;
constexpr int iteration_limit = 200;
constexpr double quantile = 0.65;           // so many points at least belong to the surface
constexpr double quantile_in_sd = 0.93459;  // of a normal deviation's magnitude
constexpr double median_in_sd = 0.67449;
constexpr double width_in_sd = 2.5;  // of the robust loss

Revolution moved(const Freedom& freedom, const Revolution& start, const Basis& basis, const double* x) {
  Revolution surface = start;
  for (int k = 0; k < freedom.shifts; ++k) surface.origin += *x++ * basis.shifts[static_cast<std::size_t>(k)];
  for (int k = 0; k < freedom.tilts; ++k) surface.axis += *x++ * basis.tilts[static_cast<std::size_t>(k)];
  for (int k = 0; k < freedom.profile; ++k) surface.profile[static_cast<std::size_t>(k)] += *x++;
  surface.axis.normalize();
  return surface;
}

/// One residual per point, d / sqrt(1 + d^2 / w^2): the least squares of them is Geman and McClure's robust sum.
struct RobustResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  const RevolutionKind& kind;
  Freedom freedom;
  std::span<const Vec3> points;
  Revolution start;
  Basis basis;
  double inverse_width2;

  int NumResiduals() const { return static_cast<int>(points.size()); }
  int NumParameters() const { return freedom.count(); }

  bool operator()(const double* x, double* residuals, double* jacobian) const {
    const Revolution surface = moved(freedom, start, basis, x);
    // A tilt of the axis that is no longer the start's: what of it turns the axis, and how far.
    Basis now = basis;
    Vec3 axis = start.axis;
    for (int k = 0; k < freedom.tilts; ++k) axis += x[freedom.shifts + k] * basis.tilts[static_cast<std::size_t>(k)];
    for (Vec3& tilt : now.tilts) tilt = (tilt - tilt.dot(surface.axis) * surface.axis) / axis.norm();
    std::array<double, 7> gradient = {};
    const std::size_t rows = points.size();
    for (std::size_t i = 0; i < rows; ++i) {
      const double d = signed_distance(kind, freedom, surface, now, points[i], jacobian ? gradient.data() : nullptr);
      const double g = 1 / std::sqrt(1 + d * d * inverse_width2);
      residuals[i] = g * d;
      if (!jacobian) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(freedom.count()); ++k)
        jacobian[k * rows + i] = g * g * g * gradient[k];
    }
    return true;
  }
};

/// Works on points about their centroid, in units of their spread.
class Search {
 public:
  Search(const RevolutionKind& kind, std::vector<Vec3> points, const PrincipalAxes& principal, double noise_floor)
      : kind_(kind), freedom_(kind.freedom()), principal_(principal), noise_floor_(noise_floor) {
    all_ = representatives(points, Vec3::Zero(), refine_points);
    some_ = representatives(all_, Vec3::Zero(), compare_points);
    few_ = representatives(some_, Vec3::Zero(), search_points);
  }

  Estimate run() {
    std::vector<Start> starts = ranked_starts();
    Start best;
    for (Start& start : starts) {
      if (!std::isfinite(start.value)) continue;
      FitSummary summary;
      double noise = std::max(start.value / quantile_in_sd, noise_floor_);
      for (int round = 0; round < 2; ++round) {
        minimize(some_, width_in_sd * noise, 1e-4, 30, start.surface, summary);
        noise = noise_of(some_, start.surface, noise);
      }
      start.value = quantile_of(some_, start.surface);
      if (start.value < best.value) best = start;
    }
    if (!std::isfinite(best.value)) {
      Estimate none;
      none.summary.message = std::string("no ") + kind_.name() + " is found near the points";
      return none;
    }
    return refined(best.surface, best.value);
  }

  Estimate refined(const Revolution& start) { return refined(start, quantile_of(all_, start)); }

 private:
  struct Start {
    double value = std::numeric_limits<double>::infinity();
    Revolution surface;
  };

  /// \param distance  from the start, the quantile of the points
  Estimate refined(const Revolution& start, double distance) {
    Estimate estimate;
    estimate.surface = start;
    double noise = std::max(distance / quantile_in_sd, noise_floor_), initial_cost = 0;
    for (int round = 0; round < 3; ++round) {
      noise = noise_of(all_, estimate.surface, noise);
      // The first rounds only serve to find the noise.
      minimize(all_, width_in_sd * noise, round < 2 ? 1e-4 : 1e-10, iteration_limit, estimate.surface,
               estimate.summary);
      if (round == 0) initial_cost = estimate.summary.initial_cost;
    }
    estimate.summary.initial_cost = initial_cost;
    return estimate;
  }

  std::vector<Start> ranked_starts() {
    std::vector<Start> starts;
    const auto add = [&](std::optional<Revolution> surface) {
      if (surface && freedom_.tilts == 0) surface->axis = principal_.axes[2];
      if (surface && surface->origin.allFinite() && surface->axis.allFinite())
        starts.push_back({quantile_of(few_, *surface), *surface});
    };
    for (const Vec3& axis : principal_.axes)
      if (const auto ring = ring_about(axis)) add(kind_.about(*ring, some_));
    const std::vector<OrientedPoint> oriented = local_normals(few_, all_, neighbours);
    const std::size_t wanted = kind_.start_points(), n = oriented.size();
    if (n >= wanted) add(kind_.through(oriented));
    LinearCongruential random;
    std::vector<OrientedPoint> sample(wanted);
    for (int k = 0; k < random_starts && n >= wanted; ++k) {
      for (OrientedPoint& point : sample) point = oriented[random.below(n)];
      add(kind_.through(sample));
    }
    const std::size_t count = std::min(refined_starts, starts.size());
    std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(count), starts.end(),
                      [](const Start& a, const Start& b) { return a.value < b.value; });
    starts.resize(count);
    return starts;
  }

  std::optional<Revolution> ring_about(const Vec3& axis) const {
    const std::array<Vec3, 3> frame = frame_about(axis, principal_);
    std::vector<std::array<double, 2>> seen;
    for (const Vec3& p : some_) seen.push_back({p.dot(frame[0]), p.dot(frame[1])});
    const auto circle = plane_circle(seen);
    if (!circle) return std::nullopt;
    return Revolution{circle->x * frame[0] + circle->y * frame[1], axis, {circle->radius, 0}};
  }

  double quantile_of(std::span<const Vec3> points, const Revolution& surface) {
    distances_.clear();
    for (const Vec3& p : points)
      distances_.push_back(std::abs(signed_distance(kind_, freedom_, surface, {}, p, nullptr)));
    const auto at = distances_.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(points.size() - 1));
    if (std::any_of(distances_.begin(), distances_.end(), [](double d) { return !std::isfinite(d); }))
      return std::numeric_limits<double>::infinity();
    std::nth_element(distances_.begin(), at, distances_.end());
    return *at;
  }

  /// Noise of the points near the surface, by the median.
  double noise_of(std::span<const Vec3> points, const Revolution& surface, double noise) {
    distances_.clear();
    for (const Vec3& p : points) {
      const double d = std::abs(signed_distance(kind_, freedom_, surface, {}, p, nullptr));
      if (d < 3.5 * noise) distances_.push_back(d);
    }
    if (distances_.empty()) return noise;
    const auto middle = distances_.begin() + static_cast<std::ptrdiff_t>(distances_.size() / 2);
    std::nth_element(distances_.begin(), middle, distances_.end());
    return std::max(*middle / median_in_sd, noise_floor_);
  }

  void minimize(std::span<const Vec3> points, double width, double tolerance, int limit, Revolution& surface,
                FitSummary& summary) const {
    const std::array<Vec3, 3> frame = frame_about(surface.axis, principal_);
    const RobustResiduals residuals{kind_, freedom_, points, surface, {frame, frame}, 1 / (width * width)};
    ceres::TinySolver<RobustResiduals> solver;
    solver.options.max_num_iterations = limit;
    solver.options.gradient_tolerance = 1e-14;
    solver.options.parameter_tolerance = tolerance;
    // No point costs more than half the width squared; below this, changes of the sum are rounding.
    solver.options.function_tolerance = 1e-16 * static_cast<double>(points.size()) * width * width;
    solver.options.cost_threshold = 1e-28;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(freedom_.count());
    solver.Solve(residuals, &x);
    surface = moved(freedom_, surface, {frame, frame}, x.data());
    const bool converged = solver.summary.status != solver.HIT_MAX_ITERATIONS;
    summary.termination = converged ? Termination::converged : Termination::iteration_limit;
    summary.message = converged ? "converged" : "no convergence in " + std::to_string(limit) + " iterations";
    summary.iterations += solver.summary.iterations;
    summary.initial_cost = solver.summary.initial_cost;
    summary.final_cost = solver.summary.final_cost;
  }

  const RevolutionKind& kind_;
  Freedom freedom_;
  PrincipalAxes principal_;
  double noise_floor_;
  std::vector<Vec3> all_, some_, few_;  // ever fewer
  std::vector<double> distances_;
};

}  // namespace

std::array<Vec3, 3> frame_about(const Vec3& axis, const PrincipalAxes& principal) {
  const Vec3* across = &principal.axes[0];
  for (const Vec3& each : principal.axes)
    if (std::abs(each.dot(axis)) < std::abs(across->dot(axis))) across = &each;
  const Vec3 u = (*across - across->dot(axis) * axis).normalized();
  return {u, axis.cross(u), axis};
}

double signed_distance(const RevolutionKind& kind, const Freedom& freedom, const Revolution& surface,
                       const Basis& basis, const Vec3& point, double* gradient) {
  const Vec3 arm = point - surface.origin;
  const double height = arm.dot(surface.axis);
  const Vec3 lateral = arm - height * surface.axis;
  const double radius = lateral.norm(), inverse = radius > 0 ? 1 / radius : 0;
  const ProfileDistance d = kind.distance(radius, height, surface.profile);
  if (!gradient) return d.value;
  for (int k = 0; k < freedom.shifts; ++k) {
    const Vec3& way = basis.shifts[static_cast<std::size_t>(k)];
    *gradient++ = -d.by_radius * inverse * lateral.dot(way) - d.by_height * surface.axis.dot(way);
  }
  for (int k = 0; k < freedom.tilts; ++k) {
    const double along = arm.dot(basis.tilts[static_cast<std::size_t>(k)]);
    *gradient++ = along * (d.by_height - d.by_radius * inverse * height);
  }
  for (int k = 0; k < freedom.profile; ++k) *gradient++ = d.by_profile[static_cast<std::size_t>(k)];
  return d.value;
}

Estimate estimate(const RevolutionKind& kind, std::span<const Vec3> points, const PrincipalAxes& principal,
                  double noise_floor, const Revolution* start) {
  const double unit = std::sqrt(principal.variance[0] + principal.variance[1] + principal.variance[2]);
  std::vector<Vec3> centred;
  centred.reserve(points.size());
  for (const Vec3& p : points) centred.push_back((p - principal.centroid) / unit);
  Search search(kind, std::move(centred), principal, std::max(noise_floor / unit, 1e-6));
  Estimate found;
  if (start == nullptr) {
    found = search.run();
  } else {
    Revolution inner = *start;
    inner.origin = (start->origin - principal.centroid) / unit;
    inner.profile[0] /= unit;
    if (!kind.freedom().second_is_angle) inner.profile[1] /= unit;
    found = search.refined(inner);
  }
  Revolution& surface = found.surface;
  surface.origin = principal.centroid + unit * surface.origin;
  surface.profile[0] *= unit;
  if (!kind.freedom().second_is_angle) surface.profile[1] *= unit;
  found.summary.initial_cost *= unit * unit;
  found.summary.final_cost *= unit * unit;
  return found;
}

}  // namespace toposcope::revolution
