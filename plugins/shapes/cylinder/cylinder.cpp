// SPDX-License-Identifier: BSD-3-Clause
// Fits a circular cylinder to working sets and says what it explains of them.

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

/// profile[0] is the radius.
class Cylinder final : public RevolutionKind {
 public:
  const char* name() const override { return "cylinder"; }
  Freedom freedom() const override { return {.shifts = 2, .tilts = 2, .profile = 1}; }

  ProfileDistance distance(double radius, double /*height*/, const std::array<double, 2>& profile) const override {
    return {radius - profile[0], 1, 0, {-1, 0}};
  }

  std::size_t start_points() const override { return 2; }

  /// The axis is square to the normals, and the normals meet it.
  std::optional<Revolution> through(std::span<const OrientedPoint> points) const override {
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    Vec3 mean = Vec3::Zero();
    for (const OrientedPoint& each : points) {
      scatter += each.normal * each.normal.transpose();
      mean += each.point / static_cast<double>(points.size());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
    const Vec3 axis = eigen.eigenvectors().col(0), u = eigen.eigenvectors().col(1), v = eigen.eigenvectors().col(2);
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const auto& [point, normal] : points) {
      const Eigen::Vector2d p((point - mean).dot(u), (point - mean).dot(v)), n(normal.dot(u), normal.dot(v));
      const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - n * n.transpose() / n.squaredNorm();
      matrix += across;
      right += across * p;
    }
    const auto solver = Eigen::FullPivLU<Eigen::Matrix2d>(matrix).setThreshold(1e-6);
    if (!matrix.allFinite() || !solver.isInvertible()) return std::nullopt;  // parallel normals meet nowhere
    const Eigen::Vector2d center = solver.solve(right);
    Revolution surface{mean + center.x() * u + center.y() * v, axis, {0, 0}};
    for (const OrientedPoint& each : points)
      surface.profile[0] += position(surface, each.point).radius / static_cast<double>(points.size());
    return surface;
  }

  std::optional<Revolution> about(const Revolution& ring, std::span<const Vec3>) const override { return ring; }

  std::string report(const Revolution& surface, const RevolutionAccount& account, const FitInput& input,
                     FittedShape& shape) const override {
    const double radius = surface.profile[0], sd = std::sqrt(account.variance(4)), edge = input.mean_edge;
    if (!(radius > 0) || !(radius <= flat_diagonals * input.box.diagonal()) || !(sd <= radius * most_uncertain_radius))
      return "the points cannot be told from a plane: the cylinder's radius is uncertain, or above 10 box diagonals";
    const double middle = (account.low + account.high) / 2;
    const Vec3 p = surface.origin + middle * surface.axis, a = surface.axis;
    shape.parameters = {
        {"point", 3, {p.x(), p.y(), p.z()}}, {"axis", 3, {a.x(), a.y(), a.z()}}, {"radius", 1, {radius}}};
    shape.coverage = account.turn;
    // The patch ends somewhere within an edge of its last vertices.
    shape.measures = {{"radius", radius, sd},
                      {"length", account.high - account.low, edge},
                      {"area", account.area, edge * std::sqrt(account.area)},
                      {"coverage", account.turn, 0}};
    std::vector<double> derivatives = account.point_on_axis(middle);
    for (const double each : account.axis_direction()) derivatives.push_back(each);
    derivatives.insert(derivatives.end(), {0, 0, 0, 0, 1});
    shape.covariance_of = {"point.x", "point.y", "point.z", "axis.x", "axis.y", "axis.z", "radius"};
    shape.covariance = account.of(derivatives);
    shape.orientation = Orientation::line_like;
    shape.direction = a;
    shape.direction_sd = std::sqrt((account.variance(2) + account.variance(3)) / 2);
    shape.centroid = p;
    const double along = account.position_variance / account.samples;
    shape.centroid_sd = std::sqrt((shape.covariance[0] + shape.covariance[8] + shape.covariance[16] + along) / 3);
    shape.outline = two_rings(surface, account, {radius, radius}).points(edge);
    return {};
  }
};

class CylinderFitter final : public RevolutionFitter {
 public:
  explicit CylinderFitter(const Options& options) : RevolutionFitter(std::make_unique<Cylinder>(), options) {}

  double distance(const FittedShape& shape, const Vec3& point) const override {
    const Revolution surface{vector_parameter(shape, "point"), vector_parameter(shape, "axis"), {}};
    return std::abs(position(surface, point).radius - number_parameter(shape, "radius"));
  }
};

constexpr OptionSpec options[] = {scale_option("points within two scales of the cylinder belong to it")};
constexpr ProvidedName measures[] = {{"radius", 1, "radius of the cylinder"},
                                     {"length", 1, "extent of the cylinder's points along the axis"},
                                     {"area", 2, "area that has points"},
                                     {"coverage", 0, "part of the turn about the axis that has points"}};

}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, CylinderFitter,
                 {.id = "cylinder",
                  .version = "1.0.0",
                  .summary = "circular cylinder: a point on the axis, the axis, radius",
                  .min_arity = 1,
                  .max_arity = 0,
                  .dimension = 2,
                  .options = options,
                  .provides = measures})
