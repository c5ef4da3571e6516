// SPDX-License-Identifier: BSD-3-Clause
// Fits a circular cone to working sets and says what it explains of them.

#include <Eigen/Eigenvalues>
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

constexpr double least_angle = pi / 180, degrees = 180 / pi;

/// profile: radius at the origin, and half of the opening angle (rad). So a cone that is nearly a cylinder is as well
/// conditioned as any other; the axis runs from the apex into the cone.
class Cone final : public RevolutionKind {
 public:
  const char* name() const override { return "cone"; }
  Freedom freedom() const override { return {.shifts = 2, .tilts = 2, .profile = 2, .second_is_angle = true}; }

  ProfileDistance distance(double radius, double height, const std::array<double, 2>& profile) const override {
    const double c = std::cos(profile[1]), s = std::sin(profile[1]), beyond = radius - profile[0];
    return {beyond * c - height * s, c, -s, {-c, -beyond * s - height * c}};
  }

  std::size_t start_points() const override { return 3; }

  /// The tangent planes meet in the apex, and the directions from there make one angle with the axis.
  std::optional<Revolution> through(std::span<const OrientedPoint> points) const override {
    const double n = static_cast<double>(points.size());
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero(), scatter = matrix;
    Vec3 right = Vec3::Zero(), mean = Vec3::Zero();
    for (const auto& [point, normal] : points) {
      matrix += normal * normal.transpose() / n;
      right += normal * normal.dot(point) / n;
    }
    const auto solver = Eigen::FullPivLU<Eigen::Matrix3d>(matrix).setThreshold(1e-9);
    if (!solver.isInvertible()) return std::nullopt;
    const Vec3 apex = solver.solve(right);
    for (const OrientedPoint& each : points) mean += (each.point - apex).normalized() / n;
    for (const OrientedPoint& each : points) {
      const Vec3 off = (each.point - apex).normalized() - mean;
      scatter += off * off.transpose();
    }
    if (!scatter.allFinite()) return std::nullopt;
    Vec3 axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
    if (axis.dot(mean) < 0) axis = -axis;
    const double angle = std::acos(std::clamp(axis.dot(mean), 0.0, 1.0));
    double height = 0;
    for (const OrientedPoint& each : points) height += (each.point - apex).dot(axis) / n;
    return Revolution{apex + height * axis, axis, {height * std::tan(angle), angle}};
  }

  /// The radius as a linear function of the height.
  std::optional<Revolution> about(const Revolution& ring, std::span<const Vec3> points) const override {
    const double n = static_cast<double>(points.size());
    double z = 0, r = 0, zz = 0, zr = 0;
    for (const Vec3& point : points) {
      const auto [radius, height] = position(ring, point);
      z += height / n, r += radius / n, zz += height * height / n, zr += height * radius / n;
    }
    const double slope = (zr - z * r) / (zz - z * z);
    if (!std::isfinite(slope)) return std::nullopt;
    return Revolution{ring.origin, ring.axis, {r - slope * z, std::atan(slope)}};
  }

  Revolution settled(const Revolution& surface) const override {
    Revolution upright = surface;
    upright.profile[1] = std::remainder(surface.profile[1], pi);  // a line turned by half a turn is itself
    if (upright.profile[1] < 0) {
      upright.axis = -surface.axis;
      upright.profile[1] = -upright.profile[1];
    }
    return upright;
  }

  std::string report(const Revolution& surface, const RevolutionAccount& account, const FitInput& input,
                     FittedShape& shape) const override {
    const auto [at_origin, angle] = surface.profile;
    const double sd = std::sqrt(account.variance(5)), edge = input.mean_edge;
    if (!(angle >= least_angle) || !(sd <= angle * most_uncertain))
      return "the points cannot be told from a cylinder: the cone's half angle is uncertain, or below 1 deg";
    if (!(pi / 2 - angle >= least_angle) || !(sd <= (pi / 2 - angle) * most_uncertain))
      return "the points cannot be told from a plane: the cone's half angle is uncertain, or above 89 deg";
    const double slope = std::tan(angle), to_apex = -at_origin / slope;
    RevolutionAccount upper = account;
    upper.low = std::max(account.low, to_apex);
    const double length = account.high - upper.low, widest = at_origin + account.high * slope;
    if (!(length > 0) || !(widest <= flat_diagonals * input.box.diagonal()))
      return "the points cannot be told from a plane: the cone's radius is above 10 box diagonals";
    const double middle = (upper.low + account.high) / 2;
    const Vec3 apex = surface.origin + to_apex * surface.axis, a = surface.axis;
    shape.parameters = {{"apex", 3, {apex.x(), apex.y(), apex.z()}},
                        {"axis", 3, {a.x(), a.y(), a.z()}},
                        {"half_angle", 1, {angle * degrees}}};
    std::vector<double> derivatives = account.point_on_axis(to_apex);
    for (Eigen::Index k = 0; k < 3; ++k) {  // the apex also moves along the axis with the profile
      double* row = &derivatives[static_cast<std::size_t>(k) * 6];
      row[4] = -a[k] / slope;
      row[5] = a[k] * at_origin / std::pow(std::sin(angle), 2);
    }
    for (const double each : account.axis_direction()) derivatives.push_back(each);
    derivatives.insert(derivatives.end(), {0, 0, 0, 0, 0, degrees});
    shape.covariance_of = {"apex.x", "apex.y", "apex.z", "axis.x", "axis.y", "axis.z", "half_angle"};
    shape.covariance = account.of(derivatives);
    const double by_angle = account.high / std::pow(std::cos(angle), 2);
    const double widest_sd = std::sqrt(account.of(std::array{0.0, 0.0, 0.0, 0.0, 1.0, by_angle})[0]);
    shape.coverage = account.turn;
    // The patch ends somewhere within an edge of its last vertices.
    shape.measures = {{"half_angle", angle * degrees, sd * degrees},
                      {"radius", widest, std::hypot(widest_sd, edge * std::sin(angle))},
                      {"length", length, edge},
                      {"area", account.area, edge * std::sqrt(account.area)},
                      {"coverage", account.turn, 0}};
    shape.orientation = Orientation::line_like;
    shape.direction = a;
    shape.direction_sd = std::sqrt((account.variance(2) + account.variance(3)) / 2);
    shape.centroid = surface.origin + middle * a;
    const std::vector<double> center = account.of(account.point_on_axis(middle));
    const double along = account.position_variance / account.samples;
    shape.centroid_sd = std::sqrt((center[0] + center[4] + center[8] + along) / 3);
    shape.outline = two_rings(surface, upper, {at_origin + upper.low * slope, widest}).points(edge);
    return {};
  }
};

class ConeFitter final : public RevolutionFitter {
 public:
  explicit ConeFitter(const Options& options) : RevolutionFitter(std::make_unique<Cone>(), options) {}

  double distance(const FittedShape& shape, const Vec3& point) const override {
    const Revolution cone{vector_parameter(shape, "apex"), vector_parameter(shape, "axis"), {}};
    const double angle = number_parameter(shape, "half_angle") / degrees;
    const auto [radius, height] = position(cone, point);
    const bool before_apex = radius * std::sin(angle) + height * std::cos(angle) < 0;
    return before_apex ? std::hypot(radius, height) : std::abs(radius * std::cos(angle) - height * std::sin(angle));
  }

  Interval bounds(std::string_view measure, std::span<const Box> sets, const Options& arguments) const override {
    if (measure == "half_angle") return {1, 89};
    return RevolutionFitter::bounds(measure, sets, arguments);
  }
};

constexpr OptionSpec options[] = {scale_option("points within two scales of the cone belong to it")};
constexpr ProvidedName measures[] = {{"half_angle", 0, "angle between axis and surface, in degrees"},
                                     {"radius", 1, "greatest radius where the cone has points"},
                                     {"length", 1, "extent of the cone's points along the axis"},
                                     {"area", 2, "area that has points"},
                                     {"coverage", 0, "part of the turn about the axis that has points"}};

}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, ConeFitter,
                 {.id = "cone",
                  .version = "1.0.0",
                  .summary = "circular cone: apex, axis into the cone, half of the opening angle",
                  .min_arity = 1,
                  .max_arity = 0,
                  .dimension = 2,
                  .options = options,
                  .provides = measures})
