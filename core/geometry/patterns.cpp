// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/patterns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/revolution.h"

namespace toposcope {
namespace {

using Complex = std::complex<double>;

/// Points in the plane of least squares, and their heights over it.
struct Flattened {
  PrincipalAxes axes;
  std::vector<Complex> places;
  double height_squares = 0;

  Vec3 lift(const Complex& z) const { return axes.centroid + z.real() * axes.axes[0] + z.imag() * axes.axes[1]; }
};

std::optional<Flattened> flatten(std::span<const Vec3> points) {
  if (points.size() < 3) return std::nullopt;
  Flattened flat{principal_axes(points), {}, 0};
  const double spread = std::sqrt(flat.axes.variance[0]);
  if (!(spread > 1e-12 * flat.axes.centroid.norm()) || !(std::sqrt(flat.axes.variance[1]) > 1e-6 * spread))
    return std::nullopt;
  for (const Vec3& point : points) {
    const Vec3 arm = point - flat.axes.centroid;
    const double height = arm.dot(flat.axes.axes[2]);
    flat.places.emplace_back(arm.dot(flat.axes.axes[0]), arm.dot(flat.axes.axes[1]));
    flat.height_squares += height * height;
  }
  return flat;
}

}  // namespace

std::optional<PointCircle> regular_polygon(std::span<const Vec3> points) {
  std::optional<Flattened> flat = flatten(points);
  if (!flat) return std::nullopt;
  std::vector<Complex>& places = flat->places;
  std::sort(places.begin(), places.end(), [](const Complex& a, const Complex& b) { return std::arg(a) < std::arg(b); });
  const auto n = static_cast<double>(places.size());
  const auto corner = [&](std::size_t k) { return std::polar(1.0, 2 * pi * static_cast<double>(k) / n); };
  Complex harmonic = 0;
  for (std::size_t k = 0; k < places.size(); ++k) harmonic += places[k] * std::conj(corner(k)) / n;
  double squares = flat->height_squares;
  for (std::size_t k = 0; k < places.size(); ++k) squares += std::norm(places[k] - harmonic * corner(k));
  return PointCircle{flat->axes.centroid, flat->axes.axes[2], std::abs(harmonic), std::sqrt(squares / n)};
}

std::optional<PointCircle> point_circle(std::span<const Vec3> points) {
  const std::optional<Flattened> flat = flatten(points);
  if (!flat) return std::nullopt;
  std::vector<std::array<double, 2>> places;
  for (const Complex& z : flat->places) places.push_back({z.real(), z.imag()});
  const std::optional<PlaneCircle> circle = plane_circle(places);
  if (!circle) return std::nullopt;
  const Complex center(circle->x, circle->y);
  double squares = flat->height_squares;
  for (const Complex& z : flat->places) squares += std::pow(std::abs(z - center) - circle->radius, 2);
  return PointCircle{flat->lift(center), flat->axes.axes[2], circle->radius,
                     std::sqrt(squares / static_cast<double>(points.size()))};
}

std::optional<PointRow> point_row(std::span<const Vec3> points, bool equal) {
  if (points.size() < 3) return std::nullopt;
  const PrincipalAxes axes = principal_axes(points);
  if (!(std::sqrt(axes.variance[0]) > 1e-12 * axes.centroid.norm())) return std::nullopt;
  const Vec3& direction = axes.axes[0];
  std::vector<double> along;
  double squares = 0;
  for (const Vec3& point : points) {
    const Vec3 arm = point - axes.centroid;
    along.push_back(arm.dot(direction));
    squares += (arm - along.back() * direction).squaredNorm();
  }
  std::sort(along.begin(), along.end());
  // The regression of the sorted positions on their numbers, counted from the middle.
  const auto n = static_cast<double>(points.size());
  double slope = 0, moment = 0;
  for (std::size_t k = 0; k < along.size(); ++k) {
    const double number = static_cast<double>(k) - (n - 1) / 2;
    slope += number * along[k];
    moment += number * number;
  }
  slope /= moment;
  if (!equal) slope = (along.back() - along.front()) / (n - 1);
  for (std::size_t k = 0; equal && k < along.size(); ++k)
    squares += std::pow(along[k] - slope * (static_cast<double>(k) - (n - 1) / 2), 2);
  return PointRow{axes.centroid - slope * (n - 1) / 2 * direction, direction, slope, std::sqrt(squares / n)};
}

void measure_pattern(RelationResult& result, const RelationInput& input, double rms, int freedom, double excess) {
  const auto count = static_cast<double>(input.features.size());
  double squares = 0;
  for (const RelationOperand& each : input.features) squares += each.shape->centroid_sd * each.shape->centroid_sd;
  result.residual = std::hypot(rms, excess);
  result.sd = std::sqrt(squares / count / count);
  // Many features err together, by a plate that is bent: they count as few.
  constexpr int most_components = 6;
  result.dof = std::clamp(3 * static_cast<int>(input.features.size()) - freedom, 1, most_components);
  // Unrelated, each component of the deviation lies anywhere within the object; the root mean square is the length of
  // the deviation over the root of the number of features.
  const double k = result.dof, range = input.object_box.diagonal() / std::sqrt(count);
  result.clutter_density = std::exp(std::log(2.0) + k / 2 * std::log(pi) - std::lgamma(k / 2) - k * std::log(range));
}

}  // namespace toposcope
