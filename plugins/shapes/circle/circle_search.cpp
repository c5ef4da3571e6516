// SPDX-License-Identifier: BSD-3-Clause
// Finds where to start: robust against outliers, coarse in its answer.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "circle_fit.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/system/random.h"

namespace toposcope::circle {
namespace {

constexpr int search_triples = 60;  // with 30 % outliers all triples are spoilt once in 1e11
constexpr double quantile = 0.65;   // so many points at least belong to the circle

/// Taubin's algebraic fit in the least-squares plane of the points, by Newton's method on its characteristic
/// polynomial (Chernov 2010, section 5.9). Radius 0 where there is none.
Circle algebraic_fit(std::span<const Vec3> points) {
  const PrincipalAxes axes = principal_axes(points);
  const double n = static_cast<double>(points.size());
  double xx = 0, yy = 0, xy = 0, xz = 0, yz = 0, zz = 0;
  for (const Vec3& point : points) {
    const double x = (point - axes.centroid).dot(axes.axes[0]), y = (point - axes.centroid).dot(axes.axes[1]);
    const double z = x * x + y * y;
    xx += x * x / n, yy += y * y / n, xy += x * y / n, xz += x * z / n, yz += y * z / n, zz += z * z / n;
  }
  const double z_mean = xx + yy, determinant = xx * yy - xy * xy, z_variance = zz - z_mean * z_mean;
  const double a3 = 4 * z_mean, a2 = -3 * z_mean * z_mean - zz;
  const double a1 = z_variance * z_mean + 4 * determinant * z_mean - xz * xz - yz * yz;
  const double a0 = xz * (xz * yy - yz * xy) + yz * (yz * xx - xz * xy) - z_variance * determinant;
  double root = 0, value = a0;
  for (int i = 0; i < 50; ++i) {
    const double slope = a1 + root * (2 * a2 + 3 * a3 * root);
    const double next = root - value / slope;
    if (next == root || !std::isfinite(next)) break;
    const double next_value = a0 + next * (a1 + next * (a2 + next * a3));
    if (std::abs(next_value) >= std::abs(value)) break;
    root = next, value = next_value;
  }
  const double scale = root * root - root * z_mean + determinant;
  const double x = (xz * (yy - root) - yz * xy) / (2 * scale), y = (yz * (xx - root) - xz * xy) / (2 * scale);
  if (!std::isfinite(x) || !std::isfinite(y)) return {};
  return {axes.centroid + x * axes.axes[0] + y * axes.axes[1], axes.axes[2], std::sqrt(x * x + y * y + z_mean)};
}

Circle through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, normal = u.cross(v);
  const double area2 = normal.squaredNorm();
  // Nearly collinear triples make circles that say nothing of the points.
  if (area2 < 1e-4 * u.squaredNorm() * v.squaredNorm()) return {};
  const Vec3 arm = (u.squaredNorm() * v.cross(normal) + v.squaredNorm() * normal.cross(u)) / (2 * area2);
  return {a + arm, normal / std::sqrt(area2), arm.norm()};
}

/// Ranks circles by a quantile of the points' squared distances and moves them towards the points that they explain.
class Search {
 public:
  explicit Search(std::vector<Vec3> points) : points_(std::move(points)), distances_(points_.size()) {
    kept_.reserve(points_.size());
  }

  double quantile_of(const Circle& circle) {
    if (!(circle.radius > 0)) return std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points_.size(); ++i) distances_[i] = squared_distance(circle, points_[i]);
    const auto at =
        distances_.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(points_.size() - 1));
    std::nth_element(distances_.begin(), at, distances_.end());
    return *at;
  }

  /// Closed-form fit to the best quantile of the points ("concentration step": the quantile mean never grows).
  Circle concentrate(const Circle& circle, double limit) {
    kept_.clear();
    for (const Vec3& point : points_)
      if (squared_distance(circle, point) <= limit) kept_.push_back(point);
    return kept_.size() < 3 ? Circle{} : algebraic_fit(kept_);
  }

  Start best() {
    std::vector<Start> starts;
    const auto add = [&](const Circle& circle) { starts.push_back({quantile_of(circle), circle}); };
    add(algebraic_fit(points_));
    const std::size_t n = points_.size();
    LinearCongruential random;
    for (int k = 0; k < search_triples; ++k) {
      const std::size_t a = random.below(n), b = random.below(n), c = random.below(n);
      if (a != b && b != c && c != a) add(through(points_[a], points_[b], points_[c]));
    }
    const auto less = [](const Start& x, const Start& y) { return x.quantile < y.quantile; };
    const std::size_t few = std::min<std::size_t>(5, starts.size());
    std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(few), starts.end(), less);
    starts.resize(few);
    for (auto& [value, circle] : starts)
      for (int step = 0; step < 4 && std::isfinite(value); ++step) {
        const Circle next = concentrate(circle, value);
        const double next_value = quantile_of(next);
        if (!(next_value < value)) break;
        value = next_value, circle = next;
      }
    return *std::min_element(starts.begin(), starts.end(), less);
  }

 private:
  std::vector<Vec3> points_;
  std::vector<double> distances_;
  std::vector<Vec3> kept_;
};

}  // namespace

Start search(std::span<const Vec3> points) {
  return Search({points.begin(), points.end()}).best();
}

double noise_of_quantile(double value) {
  // Distances from a curve have two normal components: their quantiles are those of Rayleigh's distribution.
  return std::sqrt(value / (-2 * std::log(1 - quantile)));
}

}  // namespace toposcope::circle
