// SPDX-License-Identifier: BSD-3-Clause
// Fits a torus to working sets and says what it explains of them.

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>

#include "toposcope/geometry/chords.h"
#include "toposcope/geometry/revolution.h"
#include "toposcope/geometry/shape_parameters.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

/// profile: radius of the ring, radius of the tube.
class Torus final : public RevolutionKind {
 public:
  const char* name() const override { return "torus"; }
  Freedom freedom() const override { return {.shifts = 3, .tilts = 2, .profile = 2}; }

  ProfileDistance distance(double radius, double height, const std::array<double, 2>& profile) const override {
    const double beyond = radius - profile[0], away = std::hypot(beyond, height), inverse = away > 0 ? 1 / away : 0;
    return {away - profile[1], beyond * inverse, height * inverse, {-beyond * inverse, -1}};
  }

  std::size_t start_points() const override { return 6; }

  /// The normals of a surface of revolution meet its axis: a linear line complex (Pottmann and Wallner 2001).
  std::optional<Revolution> through(std::span<const OrientedPoint> points) const override {
    Vec3 mean = Vec3::Zero();
    for (const OrientedPoint& each : points) mean += each.point / static_cast<double>(points.size());
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero(), mixed = moments, normals = moments;
    for (const auto& [point, normal] : points) {
      const Vec3 moment = (point - mean).cross(normal);
      moments += moment * moment.transpose();
      mixed += moment * normal.transpose();
      normals += normal * normal.transpose();
    }
    const auto solver = Eigen::FullPivLU<Eigen::Matrix3d>(normals).setThreshold(1e-9);
    if (!solver.isInvertible()) return std::nullopt;
    // Least of (a.moment + m.normal)^2 over the axis' moment m, then over its unit direction a.
    const Eigen::Matrix3d by_direction = moments - mixed * solver.solve(mixed.transpose());
    const Eigen::Matrix3d symmetric = (by_direction + by_direction.transpose()) / 2;
    if (!symmetric.allFinite()) return std::nullopt;
    const Vec3 axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric).eigenvectors().col(0);
    const Vec3 moment = -solver.solve(mixed.transpose() * axis);
    std::vector<Vec3> positions;
    for (const OrientedPoint& each : points) positions.push_back(each.point);
    return about({mean + axis.cross(moment), axis, {}}, positions);
  }

  /// A circle through the points' radii and heights.
  std::optional<Revolution> about(const Revolution& ring, std::span<const Vec3> points) const override {
    std::vector<std::array<double, 2>> profile;
    for (const Vec3& point : points) {
      const auto [radius, height] = position(ring, point);
      profile.push_back({radius, height});
    }
    const auto circle = plane_circle(profile);
    if (!circle || !(circle->x > 0)) return std::nullopt;
    return Revolution{ring.origin + circle->y * ring.axis, ring.axis, {circle->x, circle->radius}};
  }

  /// About the axis, and about the middle line of the tube.
  std::array<double, 2> sagittas(const Revolution& surface, const RevolutionAccount& account,
                                 std::span<const Vec3> points) const override {
    std::vector<double> angles;
    for (const Vec3& point : points) {
      const auto [radius, height] = position(surface, point);
      angles.push_back(std::atan2(height, radius - surface.profile[0]));
    }
    return {RevolutionKind::sagittas(surface, account, points)[0],
            typical_sagitta(std::move(angles), surface.profile[1])};
  }

  std::string report(const Revolution& surface, const RevolutionAccount& account, const FitInput& input,
                     FittedShape& shape) const override {
    const auto [major, minor] = surface.profile;
    const double major_sd = std::sqrt(account.variance(5)), minor_sd = std::sqrt(account.variance(6));
    if (!(minor > 0) || !(major >= minor)) return "the tube is wider than the ring: no torus, perhaps a sphere";
    if (!(major <= flat_diagonals * input.box.diagonal()) || !(major_sd <= major * most_uncertain_radius))
      return "the points cannot be told from a cylinder: the ring's radius is uncertain, or above 10 box diagonals";
    if (!(minor_sd <= minor * most_uncertain_radius)) return "the points do not determine the radius of the tube";
    const Vec3 c = surface.origin, a = surface.axis;
    shape.parameters = {{"center", 3, {c.x(), c.y(), c.z()}},
                        {"axis", 3, {a.x(), a.y(), a.z()}},
                        {"major_radius", 1, {major}},
                        {"minor_radius", 1, {minor}}};
    shape.coverage = std::min(1.0, account.area / (4 * pi * pi * major * minor));
    shape.measures = {{"major_radius", major, major_sd},
                      {"minor_radius", minor, minor_sd},
                      {"area", account.area, input.mean_edge * std::sqrt(account.area)},
                      {"coverage", shape.coverage, 0}};
    std::vector<double> derivatives = account.point_on_axis(0);
    for (const double each : account.axis_direction()) derivatives.push_back(each);
    derivatives.insert(derivatives.end(), {0, 0, 0, 0, 0, 1, 0});
    derivatives.insert(derivatives.end(), {0, 0, 0, 0, 0, 0, 1});
    shape.covariance_of = {"center.x", "center.y", "center.z",     "axis.x",
                           "axis.y",   "axis.z",   "major_radius", "minor_radius"};
    shape.covariance = account.of(derivatives);
    shape.orientation = Orientation::plane_like;
    shape.direction = a;
    shape.direction_sd = std::sqrt((account.variance(3) + account.variance(4)) / 2);
    shape.centroid = c;
    shape.centroid_sd = std::sqrt((account.variance(0) + account.variance(1) + account.variance(2)) / 3);
    const auto& [u, v, axis] = account.frame;
    OutlinePath path;  // around outside, under the tube, around inside, and over it
    path.arc(c, (major + minor) * u, (major + minor) * v, 0, 2 * pi);
    path.arc(c + major * u, minor * u, minor * axis, 0, -pi);
    path.arc(c, (major - minor) * u, (major - minor) * v, 0, 2 * pi);
    path.arc(c + major * u, minor * u, minor * axis, pi, 0);
    shape.outline = path.points(input.mean_edge);
    return {};
  }
};

class TorusFitter final : public RevolutionFitter {
 public:
  explicit TorusFitter(const Options& options) : RevolutionFitter(std::make_unique<Torus>(), options) {}

  double distance(const FittedShape& shape, const Vec3& point) const override {
    const Revolution torus{vector_parameter(shape, "center"), vector_parameter(shape, "axis"), {}};
    const auto [radius, height] = position(torus, point);
    return std::abs(std::hypot(radius - number_parameter(shape, "major_radius"), height) -
                    number_parameter(shape, "minor_radius"));
  }
};

constexpr OptionSpec options[] = {scale_option("points within two scales of the torus belong to it")};
constexpr ProvidedName measures[] = {{"major_radius", 1, "radius of the ring, the tube's middle line"},
                                     {"minor_radius", 1, "radius of the tube"},
                                     {"area", 2, "area that has points"},
                                     {"coverage", 0, "part of the torus' area that has points"}};

}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, TorusFitter,
                 {.id = "torus",
                  .version = "1.0.0",
                  .summary = "torus: centre, axis, radius of the ring, radius of the tube",
                  .min_arity = 1,
                  .max_arity = 0,
                  .dimension = 2,
                  .options = options,
                  .provides = measures})
