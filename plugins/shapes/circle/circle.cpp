// SPDX-License-Identifier: BSD-3-Clause
// Fits a circle in space to working sets (dissertation 4.4.1) and says what it explains of them.

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "circle_fit.h"
#include "toposcope/geometry/chords.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/shape_parameters.h"
#include "toposcope/geometry/turn_coverage.h"
#include "toposcope/plugin.h"

namespace toposcope::circle {
namespace {

constexpr double radius_limit_diagonals = 100;
constexpr std::size_t outline_limit = 512;

/// Inverse of a normal matrix whose variances end at `limit`: a direction that the points leave open is uncertain, not
/// exact as a pseudo-inverse would have it.
Eigen::Matrix<double, 6, 6> inverse_up_to(const Eigen::Matrix<double, 6, 6>& information, double limit) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(information);
  const Eigen::Matrix<double, 6, 1> variance = eigen.eigenvalues().cwiseMax(1 / limit).cwiseInverse();
  return eigen.eigenvectors() * variance.asDiagonal() * eigen.eigenvectors().transpose();
}

/// Axes of the circle's plane that turn with the points: the first towards their centroid where that is not the
/// centre, so that bins and outline do not depend on the pose.
std::array<Vec3, 2> plane_axes(const Circle& circle, std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : points) mean += (point - circle.center) / static_cast<double>(points.size());
  mean -= mean.dot(circle.normal) * circle.normal;
  const Vec3 u = mean.norm() > 1e-6 * circle.radius ? Vec3(mean.normalized()) : any_perpendicular(circle.normal);
  return {u, circle.normal.cross(u)};
}

/// What points say of a circle: normal matrix with all parameters as lengths, the tilts as the displacement that they
/// give to points of the circle.
struct Evidence {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<Vec3> points;
  double squares = 0;
  double covered = 0;  ///< arc length that has points

  double count() const { return static_cast<double>(points.size()); }
  Eigen::MatrixXd per_point() const { return information / count(); }
};

using Axes = std::array<Vec3, 2>;

/// \param read_only  of points that a filter made nothing is asked
Evidence evidence_of(const Circle& circle, const Axes& axes, const FitInput& input, double reach, bool read_only) {
  Evidence evidence;
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const Vec3& point = input.points[i];
    const double d2 = squared_distance(circle, point);
    if (d2 > reach * reach || (read_only && !was_read(input, i))) continue;
    const auto rows = offset_derivative(circle, axes[0] / circle.radius, axes[1] / circle.radius, point);
    evidence.information += rows.transpose() * rows;
    evidence.squares += d2;
    evidence.points.push_back(point);
  }
  return evidence;
}

/// Whether points scatter about as far out of their plane as they bend in it: any circle is as good, and a small one
/// that runs through their noise is the best.
bool cannot_be_told_from_a_line(std::span<const Vec3> points) {
  constexpr double clearly = 2;
  const std::array<double, 3> variance = principal_axes(points).variance;
  return variance[1] < clearly * variance[2];
}

/// Moves a circle that was fitted to all points to those that were read, where there are others and these determine it
/// too: what a filter puts between them lies on chords. \return whether it did
bool move_to_read(const FitInput& input, double reach, double noise_floor, Estimate& estimate) {
  constexpr std::size_t least = 6;  // twelve residuals for six parameters
  if (input.mesh == nullptr || input.mesh->input_vertices.empty()) return false;
  const Axes axes = plane_axes(estimate.circle, input.points);
  const Evidence all = evidence_of(estimate.circle, axes, input, reach, false);
  const Evidence read = evidence_of(estimate.circle, axes, input, reach, true);
  if (read.points.size() == all.points.size() || read.points.size() < least) return false;
  if (!as_well_spread(read.per_point(), all.per_point())) return false;
  Estimate moved = refit(read.points, estimate.circle, noise_floor);
  double squares = 0;
  for (const Vec3& point : read.points) squares += std::min(squared_distance(moved.circle, point), reach * reach);
  // Where chords are not what most of the distances come from, there is nothing to gain from fewer points.
  constexpr double chords_alone = 0.25;
  if (!moved.summary.usable() || !(squares / read.count() <= chords_alone * all.squares / all.count())) return false;
  moved.summary.iterations += estimate.summary.iterations;
  estimate = std::move(moved);
  return true;
}

/// Of centre, tilts and radius, as lengths.
Eigen::Matrix<double, 6, 6> covariance_of(const Circle& circle, const Axes& axes, const Evidence& evidence,
                                          const FitInput& input, double reach) {
  // Two components a point, six parameters. Rounding is the least noise of coordinates.
  const double n = evidence.count(), rounding = 1e-16 * (input.object_box.diagonal() + circle.center.norm());
  // Neighbouring vertices err alike, so about one sample per mean edge counts.
  const double samples = std::min(n, std::max(1.0, evidence.covered / input.mean_edge));
  const double variance = std::max(evidence.squares / std::max(1.0, 2 * n - 6), rounding * rounding);
  const double limit = circle.radius * circle.radius + input.box.diagonal() * input.box.diagonal();
  Eigen::Matrix<double, 6, 6> covariance = inverse_up_to(evidence.information * (samples / n / variance), limit);
  // What residuals do not show: it is the curvature, not the radius, that errs evenly; noise along the circle moves
  // points outwards; and how deep chords lie.
  Eigen::Matrix<double, 6, 1> stretch = Eigen::Matrix<double, 6, 1>::Ones();
  stretch.head<3>().setConstant(curvature_stretch(std::sqrt(covariance(5, 5)) / circle.radius));
  stretch[5] = stretch[0];
  covariance = stretch.asDiagonal() * covariance * stretch.asDiagonal();
  covariance(5, 5) += std::pow(variance / (2 * circle.radius), 2);
  if (input.mesh != nullptr) {
    std::vector<double> angles;
    for (const Vec3& point : ends_of_chords(input)) {
      if (squared_distance(circle, point) > reach * reach) continue;
      const Vec3 arm = point - circle.center;
      angles.push_back(std::atan2(arm.dot(axes[1]), arm.dot(axes[0])));
    }
    covariance(5, 5) += chord_variance(typical_sagitta(std::move(angles), circle.radius));
  }
  return covariance;
}

/// Fills in all that follows from the circle and the points.
/// \param reach      points within it belong to the circle, mesh unit
/// \param read_only  the points that were read say how exact it is
void describe(const Circle& circle, const FitInput& input, double reach, bool read_only, FittedShape& shape) {
  const Axes axes = plane_axes(circle, input.points);
  const auto [u, v] = axes;
  const double turn = 2 * pi * circle.radius, edge = input.mean_edge;
  TurnCoverage covered(turn / edge);
  double near = 0;
  for (const Vec3& point : input.points) {
    if (squared_distance(circle, point) > reach * reach) continue;
    const Vec3 arm = point - circle.center;
    covered.add(std::atan2(arm.dot(v), arm.dot(u)), turn / edge);
    ++near;
  }
  Evidence evidence = evidence_of(circle, axes, input, reach, read_only);
  if (evidence.points.size() < 3) {
    shape.summary.termination = Termination::failed;
    shape.summary.message = std::to_string(evidence.points.size()) + " of " + std::to_string(input.points.size()) +
                            " points lie near the circle: 3 are needed (option 'scale')";
    return;
  }
  if (cannot_be_told_from_a_line(evidence.points)) {
    shape.summary.termination = Termination::degenerate;
    shape.summary.message = "the points cannot be told from a line: off it they scatter in all directions";
    return;
  }
  shape.rms = std::sqrt(evidence.squares / evidence.count());
  shape.coverage = covered.part();
  shape.explained = shape.coverage * turn / edge;
  shape.unexplained = (static_cast<double>(input.points.size()) - near) / (near / shape.explained);

  evidence.covered = shape.coverage * turn;
  const Eigen::Matrix<double, 6, 6> covariance = covariance_of(circle, axes, evidence, input, reach);
  Eigen::Matrix<double, 7, 6> spread = Eigen::Matrix<double, 7, 6>::Zero();  // to centre, normal, radius
  spread.topLeftCorner<3, 3>().setIdentity();
  spread.block<3, 1>(3, 3) = u / circle.radius;
  spread.block<3, 1>(3, 4) = v / circle.radius;
  spread(6, 5) = 1;
  const Eigen::Matrix<double, 7, 7, Eigen::RowMajor> all = spread * covariance * spread.transpose();
  shape.covariance_of = {"center.x", "center.y", "center.z", "normal.x", "normal.y", "normal.z", "radius"};
  shape.covariance.assign(all.data(), all.data() + all.size());

  const auto list = [](const Vec3& x) { return std::vector<double>{x.x(), x.y(), x.z()}; };
  shape.parameters = {
      {"center", 3, list(circle.center)}, {"normal", 3, list(circle.normal)}, {"radius", 1, {circle.radius}}};
  shape.measures = {{"radius", circle.radius, std::sqrt(covariance(5, 5))}, {"coverage", shape.coverage, 0}};
  shape.orientation = Orientation::plane_like;
  shape.direction = circle.normal;
  shape.direction_sd = std::sqrt((covariance(3, 3) + covariance(4, 4)) / 2) / circle.radius;
  shape.centroid = circle.center;
  shape.centroid_sd = std::sqrt(covariance.topLeftCorner<3, 3>().trace() / 3);
  shape.outline_closed = true;
  const std::size_t count =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::min(turn / edge, 1e6)) + 1, 8, outline_limit);
  shape.outline.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
    shape.outline[i] = circle.center + circle.radius * (std::cos(angle) * u + std::sin(angle) * v);
  }
}

class CircleFitter final : public ShapeFitter {
 public:
  explicit CircleFitter(const Options& options)
      : powell_(options.text("method") == "powell"), scale_(options.real("scale")) {}

  FittedShape fit(const FitInput& input, const Options&, Context&) const override {
    FittedShape shape;
    if (input.points.size() < 3 || !(input.mean_edge > 0)) {
      shape.summary.termination = Termination::degenerate;
      shape.summary.message = input.points.size() < 3 ? "fewer than three points: no circle is determined"
                                                      : "the mean edge length is zero: distances have no scale";
      return shape;
    }
    const double limit = radius_limit_diagonals * input.box.diagonal(), scale = scale_ * input.mean_edge;
    Estimate estimate = powell_ ? fit_powell(input.points, input.box, limit)
                                : fit_robust(input.points, noise_floor_scales * scale, limit);
    const bool moved =
        !powell_ && estimate.summary.usable() && move_to_read(input, 2 * scale, noise_floor_scales * scale, estimate);
    shape.summary = std::move(estimate.summary);
    if (shape.summary.usable()) describe(estimate.circle, input, 2 * scale, moved, shape);
    return shape;
  }

  double distance(const FittedShape& shape, const Vec3& point) const override {
    const Circle circle{vector_parameter(shape, "center"), vector_parameter(shape, "normal"),
                        number_parameter(shape, "radius")};
    return std::sqrt(offset(circle, point).squared());
  }

  /// The least radius stays open: the points that a robust fit leaves out may lie anywhere in the box.
  Interval bounds(std::string_view measure, std::span<const Box> sets, const Options&) const override {
    if (measure != "radius") return {};
    return {0, radius_limit_diagonals * enclosing_diameter(sets)};
  }

 private:
  // Without it points that lie exactly on a circle would have the noise 0 and the next one would count as an outlier.
  static constexpr double noise_floor_scales = 0.02;
  bool powell_;
  double scale_;
};

constexpr OptionSpec options[] = {
    {"method", OptionType::text, "", "robust", "", "",
     "robust: outliers do not count; powell: least squares in the points' plane, as in the dissertation",
     "robust|powell"},
    {"scale", OptionType::real, "mean-edges", "1", "0.05", "20", "points within two scales of the circle belong to it"},
};
constexpr ProvidedName measures[] = {{"radius", 1, "radius of the circle"},
                                     {"coverage", 0, "part of the turn that has points"}};

}  // namespace
}  // namespace toposcope::circle

TOPOSCOPE_PLUGIN(ShapeFitter, toposcope::circle::CircleFitter,
                 {.id = "circle",
                  .version = "1.0.0",
                  .summary = "circle in space: centre, normal, radius",
                  .citation = "Neal 1999, section 4.4.1",
                  .min_arity = 1,
                  .max_arity = 0,
                  .dimension = 1,
                  .options = toposcope::circle::options,
                  .provides = toposcope::circle::measures})
