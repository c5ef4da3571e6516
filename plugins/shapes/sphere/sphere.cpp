// SPDX-License-Identifier: BSD-3-Clause
// Fits a sphere to working sets and says what it explains of them.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>

#include "toposcope/geometry/revolution.h"
#include "toposcope/geometry/shape_parameters.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

/// profile[0] is the radius; the axis means nothing.
class Sphere final : public RevolutionKind {
 public:
  const char* name() const override { return "sphere"; }
  Freedom freedom() const override { return {.shifts = 3, .tilts = 0, .profile = 1}; }

  ProfileDistance distance(double radius, double height, const std::array<double, 2>& profile) const override {
    const double away = std::hypot(radius, height), inverse = away > 0 ? 1 / away : 0;
    return {away - profile[0], radius * inverse, height * inverse, {-1, 0}};
  }

  std::size_t start_points() const override { return 4; }

  /// Linear least squares: |p|^2 = 2 c.p + (r^2 - |c|^2); exact for four points.
  std::optional<Revolution> through(std::span<const OrientedPoint> points) const override {
    const double n = static_cast<double>(points.size());
    Vec3 mean = Vec3::Zero();
    for (const OrientedPoint& each : points) mean += each.point / n;
    Eigen::Matrix<double, 4, 5> system = Eigen::Matrix<double, 4, 5>::Zero();
    for (const OrientedPoint& each : points) {
      const Vec3 p = each.point - mean;
      const Eigen::Vector<double, 5> row(2 * p.x(), 2 * p.y(), 2 * p.z(), 1, p.squaredNorm());
      system += row.head<4>() * row.transpose() / n;
    }
    const auto solver = Eigen::FullPivLU<Eigen::Matrix4d>(system.leftCols<4>()).setThreshold(1e-9);
    if (!solver.isInvertible()) return std::nullopt;
    const Eigen::Vector4d solved = solver.solve(system.col(4));
    const double radius = std::sqrt(solved[3] + solved.head<3>().squaredNorm());
    if (!std::isfinite(radius)) return std::nullopt;
    return Revolution{mean + solved.head<3>(), Vec3::UnitZ(), {radius, 0}};
  }

  std::optional<Revolution> about(const Revolution&, std::span<const Vec3>) const override { return std::nullopt; }

  /// A triangle of even ones is as wide as its share of the area says; its middle lies deepest.
  std::array<double, 2> sagittas(const Revolution& surface, const RevolutionAccount& account,
                                 std::span<const Vec3> points) const override {
    constexpr double squared_circumradius = 0.385;  // of a triangle, per area that a vertex stands for
    return {squared_circumradius * account.area / static_cast<double>(points.size()) / (2 * surface.profile[0]), 0};
  }

  std::string report(const Revolution& surface, const RevolutionAccount& account, const FitInput& input,
                     FittedShape& shape) const override {
    const double radius = surface.profile[0], sd = std::sqrt(account.variance(3));
    if (!(radius > 0) || !(radius <= flat_diagonals * input.box.diagonal()) || !(sd <= radius * most_uncertain_radius))
      return "the points cannot be told from a plane: the sphere's radius is uncertain, or above 10 box diagonals";
    const Vec3& c = surface.origin;
    shape.parameters = {{"center", 3, {c.x(), c.y(), c.z()}}, {"radius", 1, {radius}}};
    shape.coverage = std::min(1.0, account.area / (4 * pi * radius * radius));
    shape.measures = {{"radius", radius, sd},
                      {"area", account.area, input.mean_edge * std::sqrt(account.area)},
                      {"coverage", shape.coverage, 0}};
    std::vector<double> derivatives = account.point_on_axis(0);
    derivatives.insert(derivatives.end(), {0, 0, 0, 1});
    shape.covariance_of = {"center.x", "center.y", "center.z", "radius"};
    shape.covariance = account.of(derivatives);
    shape.centroid = c;
    shape.centroid_sd = std::sqrt((shape.covariance[0] + shape.covariance[5] + shape.covariance[10]) / 3);
    draw_cap(surface, account, input, shape);
    return {};
  }

 private:
  /// The outline: a line over the middle of the points, and the rim of the cap around them or the great circle square
  /// to it.
  static void draw_cap(const Revolution& surface, const RevolutionAccount& account, const FitInput& input,
                       FittedShape& shape) {
    const double radius = surface.profile[0];
    Vec3 sum = Vec3::Zero();
    std::vector<Vec3> directions;
    for (const Vec3& point : input.points) {
      const Vec3 arm = point - surface.origin;
      const double length = arm.norm();
      if (!(std::abs(length - radius) <= account.reach) || !(length > 0)) continue;
      directions.push_back(arm / length);
      sum += directions.back();
    }
    const bool lopsided = sum.norm() > 1e-6 * static_cast<double>(directions.size());
    const Vec3 pole = lopsided ? Vec3(sum.normalized()) : account.frame[2];
    double cap = 0;
    for (const Vec3& d : directions) cap = std::max(cap, std::atan2(d.cross(pole).norm(), d.dot(pole)));
    const Vec3* across = &account.frame[0];
    for (const Vec3& each : account.frame)
      if (std::abs(each.dot(pole)) < std::abs(across->dot(pole))) across = &each;
    const Vec3 u = (*across - across->dot(pole) * pole).normalized(), v = pole.cross(u);
    const double rim = std::min(cap, pi / 2);
    OutlinePath path;
    path.arc(surface.origin, radius * pole, radius * u, -cap, rim);
    path.arc(surface.origin + radius * std::cos(rim) * pole, radius * std::sin(rim) * u, radius * std::sin(rim) * v, 0,
             2 * pi);
    if (cap > rim) path.arc(surface.origin, radius * pole, radius * u, rim, cap);
    shape.outline = path.points(input.mean_edge);
  }
};

class SphereFitter final : public RevolutionFitter {
 public:
  explicit SphereFitter(const Options& options) : RevolutionFitter(std::make_unique<Sphere>(), options) {}

  double distance(const FittedShape& shape, const Vec3& point) const override {
    return std::abs((point - vector_parameter(shape, "center")).norm() - number_parameter(shape, "radius"));
  }
};

constexpr OptionSpec options[] = {scale_option("points within two scales of the sphere belong to it")};
constexpr ProvidedName measures[] = {{"radius", 1, "radius of the sphere"},
                                     {"area", 2, "area that has points"},
                                     {"coverage", 0, "part of the sphere's area that has points"}};

}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, SphereFitter,
                 {.id = "sphere",
                  .version = "1.0.0",
                  .summary = "sphere: centre, radius",
                  .min_arity = 1,
                  .max_arity = 0,
                  .dimension = 2,
                  .options = options,
                  .provides = measures})
