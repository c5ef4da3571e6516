// SPDX-License-Identifier: BSD-3-Clause
// Fits a plane to working sets (dissertation 4.4.3) and says what it explains of them.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/shape_parameters.h"
#include "toposcope/plugin.h"

namespace toposcope::plane {
namespace {

constexpr int iteration_limit = 200;
constexpr std::size_t outline_limit = 512;

struct Plane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};

double height(const Plane& plane, const Vec3& point) {
  return (point - plane.point).dot(plane.normal);
}

/// Weighted total least squares: through the weighted mean, normal along the axis of least scatter.
Plane weighted_fit(std::span<const Vec3> points, std::span<const double> weights) {
  double sum = 0;
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += weights[i];
    mean += weights[i] * (points[i] - points[0]);  // about a point of the set: far from the origin nothing is lost
  }
  mean = points[0] + mean / sum;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 arm = points[i] - mean;
    scatter += (weights[i] / sum * arm) * arm.transpose();
  }
  return {mean, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0)};
}

/// Standard deviation of the heights by their median, not below `floor`.
double noise_of(std::vector<double> heights, double floor) {
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  for (double& height : heights) height = std::abs(height);
  std::nth_element(heights.begin(), middle, heights.end());
  return std::max(1.4826 * *middle, floor);
}

double half_squares(std::span<const double> heights) {
  double sum = 0;
  for (const double h : heights) sum += h * h / 2;
  return sum;
}

/// Iterated reweighting with Tukey's biweight; the noise is taken from the median and shrinks as outliers lose weight.
Plane reweighted_fit(std::span<const Vec3> points, double spread, double noise_floor, Plane plane,
                     FitSummary& summary) {
  std::vector<double> heights(points.size()), weights(points.size());
  double noise = std::numeric_limits<double>::infinity();
  summary.termination = Termination::iteration_limit;
  summary.message = "no convergence in " + std::to_string(iteration_limit) + " iterations";
  for (summary.iterations = 1; summary.iterations <= iteration_limit; ++summary.iterations) {
    for (std::size_t i = 0; i < points.size(); ++i) heights[i] = height(plane, points[i]);
    noise = std::min(noise, noise_of(heights, noise_floor));  // only ever less: the iteration cannot go in circles
    const double width = 4.685 * noise;                       // 95 % efficient for normal noise
    double cost = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double rest = std::max(0.0, 1 - heights[i] * heights[i] / (width * width));
      weights[i] = rest * rest;
      cost += width * width / 6 * (1 - rest * rest * rest);
    }
    summary.final_cost = cost;
    const Plane next = weighted_fit(points, weights);
    const double tilt = next.normal.cross(plane.normal).norm();
    const double shift = std::abs(height(plane, next.point));
    plane = next;
    if (tilt + shift / spread < 1e-8) {
      summary.termination = Termination::converged;
      summary.message = "converged";
      break;
    }
  }
  return plane;
}

/// Fills in all that follows from the plane and the points.
/// \param reach  points within it belong to the plane, mesh unit
void describe(Plane plane, const FitInput& input, double reach, FittedShape& shape) {
  std::vector<Vec3> inliers;
  inliers.reserve(input.points.size());
  double squares = 0, area = 0, area_left_out = 0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const double h = height(plane, input.points[i]);
    if (std::abs(h) > reach) {
      area_left_out += input.areas[i];
      continue;
    }
    squares += h * h;
    area += input.areas[i];
    inliers.push_back(input.points[i] - h * plane.normal);
    moment += input.areas[i] * (inliers.back() - plane.point);
  }
  const PrincipalAxes axes = inliers.size() < 3 ? PrincipalAxes{} : principal_axes(inliers);
  if (inliers.size() < 3 || !(axes.variance[1] > 1e-12 * axes.variance[0])) {
    shape.summary.termination = Termination::failed;
    shape.summary.message = std::to_string(inliers.size()) + " of " + std::to_string(input.points.size()) +
                            " points lie near the plane: 3 off a line are needed (option 'scale')";
    return;
  }
  plane.point = area > 0 ? Vec3(plane.point + moment / area) : axes.centroid;
  const double n = static_cast<double>(inliers.size()), edge = input.mean_edge;
  // One per square of a mean edge, but no more than there are points to tell.
  const double samples = std::clamp(area / (edge * edge), 1.0, n);
  shape.rms = std::sqrt(squares / n);
  shape.explained = std::sqrt(area) / edge;
  shape.unexplained = std::sqrt(area_left_out) / edge;
  shape.coverage = 1;

  // The regression of heights on the two principal axes in the plane: offset and tilts are uncorrelated.
  const double rounding = 1e-16 * (input.object_box.diagonal() + plane.point.norm());
  const double variance = std::max(squares / std::max(1.0, n - 3), rounding * rounding) / samples;
  const double tilt_1 = variance / axes.variance[0];
  const double tilt_2 = std::min(variance / axes.variance[1], 1.0);
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> covariance = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>::Zero();
  covariance.topLeftCorner<3, 3>() = variance * plane.normal * plane.normal.transpose();
  covariance.bottomRightCorner<3, 3>() =
      tilt_1 * axes.axes[0] * axes.axes[0].transpose() + tilt_2 * axes.axes[1] * axes.axes[1].transpose();
  shape.covariance_of = {"point.x", "point.y", "point.z", "normal.x", "normal.y", "normal.z"};
  shape.covariance.assign(covariance.data(), covariance.data() + covariance.size());

  const auto list = [](const Vec3& x) { return std::vector<double>{x.x(), x.y(), x.z()}; };
  shape.parameters = {{"point", 3, list(plane.point)}, {"normal", 3, list(plane.normal)}};
  const Box box = oriented_box(inliers);
  // The patch ends somewhere within an edge of its last vertices.
  shape.measures = {{"extent", box.a(), edge}, {"area", area, edge * std::sqrt(area)}};
  shape.orientation = Orientation::plane_like;
  shape.direction = plane.normal;
  shape.direction_sd = std::sqrt((tilt_1 + tilt_2) / 2);
  shape.centroid = plane.point;
  shape.centroid_sd = std::sqrt((variance + (axes.variance[0] + axes.variance[1]) / samples) / 3);

  const Vec3 u = box.axes[0] * box.a() / 2, v = box.axes[1] * box.b() / 2;
  const Vec3 corners[] = {box.center - u - v, box.center + u - v, box.center + u + v, box.center - u + v,
                          box.center - u - v};
  shape.outline = resample(corners, edge, outline_limit);
  if (shape.outline.size() > 1) shape.outline.pop_back();  // the first corner again
  shape.outline_closed = true;
}

class PlaneFitter final : public ShapeFitter {
 public:
  explicit PlaneFitter(const Options& options)
      : robust_(options.text("method") == "robust"), scale_(options.real("scale")) {}

  FittedShape fit(const FitInput& input, const Options&, Context&) const override {
    FittedShape shape;
    shape.summary.termination = Termination::degenerate;
    if (input.points.size() < 3 || !(input.mean_edge > 0)) {
      shape.summary.message = input.points.size() < 3 ? "fewer than three points: no plane is determined"
                                                      : "the mean edge length is zero: distances have no scale";
      return shape;
    }
    const PrincipalAxes axes = principal_axes(input.points);
    const double spread = std::sqrt(axes.variance[0]), rounding = 1e-12 * axes.centroid.norm();
    if (!(spread > rounding) || !(std::sqrt(axes.variance[1]) > std::max(1e-6 * spread, rounding))) {
      shape.summary.message = "the points lie on one line or in one spot: no plane is determined";
      return shape;
    }
    Plane plane = weighted_fit(input.points, std::vector<double>(input.points.size(), 1.0));
    std::vector<double> heights;
    heights.reserve(input.points.size());
    for (const Vec3& point : input.points) heights.push_back(height(plane, point));
    const double cost = half_squares(heights);
    shape.summary = {Termination::closed_form, "least squares in closed form", 0, cost, cost};
    const double scale = scale_ * input.mean_edge;
    if (robust_) plane = reweighted_fit(input.points, spread, noise_floor_scales * scale, plane, shape.summary);
    if (shape.summary.usable()) describe(plane, input, 2 * scale, shape);
    return shape;
  }

  double distance(const FittedShape& shape, const Vec3& point) const override {
    return std::abs(height({vector_parameter(shape, "point"), vector_parameter(shape, "normal")}, point));
  }

  Interval bounds(std::string_view measure, std::span<const Box> sets, const Options&) const override {
    if (measure != "extent") return {0, std::numeric_limits<double>::infinity()};
    return {0, enclosing_diameter(sets) * (1 + 1e-9)};  // no two points are farther apart than the box is wide
  }

 private:
  // Without it points that lie exactly in a plane would have the noise 0 and the next one would count as an outlier.
  static constexpr double noise_floor_scales = 0.02;
  bool robust_;
  double scale_;
};

constexpr OptionSpec options[] = {
    {"method", OptionType::text, "", "robust", "", "",
     "robust: outliers lose their weight; powell: plain least squares, as in the dissertation", "robust|powell"},
    {"scale", OptionType::real, "mean-edges", "1", "0.05", "20", "points within two scales of the plane belong to it"},
};
constexpr ProvidedName measures[] = {{"extent", 1, "longest side of the box of the plane's points"},
                                     {"area", 2, "area that the plane's points cover"}};

}  // namespace
}  // namespace toposcope::plane

TOPOSCOPE_PLUGIN(ShapeFitter, toposcope::plane::PlaneFitter,
                 {.id = "plane",
                  .version = "1.0.0",
                  .summary = "plane: a point and the normal",
                  .citation = "Neal 1999, section 4.4.3",
                  .min_arity = 1,
                  .max_arity = 0,
                  .dimension = 2,
                  .options = toposcope::plane::options,
                  .provides = toposcope::plane::measures})
