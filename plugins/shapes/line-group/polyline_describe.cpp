// SPDX-License-Identifier: BSD-3-Clause
// Everything that follows from a fitted polyline and its points.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "polyline.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::line_group {
namespace {

constexpr std::size_t outline_limit = 512;
constexpr double bins_per_edge = 4, max_bins = 1 << 18;

/// Marks the bins of [0, 1] within half of `width` of a position. A point stands for an edge length of arc about
/// itself: marking only the bin that holds it would leave gaps between points that are exactly an edge apart.
void fill(double position, double width, bool closed, std::vector<char>& filled) {
  const auto count = static_cast<std::ptrdiff_t>(filled.size());
  const auto bin = [&](double x) { return static_cast<std::ptrdiff_t>(std::floor(x * static_cast<double>(count))); };
  std::ptrdiff_t first = bin(position - width / 2), last = bin(position + width / 2);
  if (!closed) first = std::max<std::ptrdiff_t>(first, 0), last = std::min(last, count - 1);
  last = std::min(last, first + count - 1);
  for (std::ptrdiff_t i = first; i <= last; ++i) filled[static_cast<std::size_t>((i + count) % count)] = 1;
}

/// Standard deviation of a linear function of the vertices, from its gradient.
double sd_of(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& covariance) {
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

void set_measures(const Polyline& polyline, const Eigen::MatrixXd& covariance, FittedShape& shape) {
  const auto size = static_cast<Eigen::Index>(3 * polyline.vertices.size());
  Eigen::VectorXd total = Eigen::VectorXd::Zero(size);
  double length = 0;
  for (std::size_t k = 0; k < polyline.segments(); ++k) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
    const std::size_t tail = polyline.tail(k), head = polyline.head(k);
    const Vec3 along = (polyline.vertices[head] - polyline.vertices[tail]).normalized();
    gradient.segment<3>(3 * head) += along;
    gradient.segment<3>(3 * tail) -= along;
    shape.measures.push_back({"length_" + std::to_string(k + 1), polyline.length(k), sd_of(gradient, covariance)});
    total += gradient;
    length += polyline.length(k);
  }
  shape.measures.push_back({"length", length, sd_of(total, covariance)});
}

/// Orientation, direction and centroid with their deviations.
void set_position(const Polyline& polyline, const Eigen::MatrixXd& covariance, FittedShape& shape) {
  const std::vector<Vec3>& v = polyline.vertices;
  const PrincipalAxes axes = principal_axes(v);
  const double spread = std::sqrt(axes.variance[0]), thickness = std::sqrt(axes.variance[1]);
  const auto size = static_cast<Eigen::Index>(3 * v.size());
  // A rotation by a small angle about an axis moves the vertices by angle x arm: regression of the moves on the arms.
  const auto turn_sd = [&](const Vec3& towards, const Vec3& arm, double variance) {
    Eigen::VectorXd gradient(size);
    for (std::size_t i = 0; i < v.size(); ++i)
      gradient.segment<3>(3 * i) =
          (v[i] - axes.centroid).dot(arm) / (variance * static_cast<double>(v.size())) * towards;
    return sd_of(gradient, covariance);
  };
  const auto rms = [](double a, double b) { return std::sqrt((a * a + b * b) / 2); };
  const bool line_like = polyline.segments() == 1 || !(thickness > std::max(1e-6 * spread, shape.rms));
  if (line_like) {
    shape.orientation = Orientation::line_like;
    shape.direction = axes.axes[0];
    shape.direction_sd = rms(turn_sd(axes.axes[1], axes.axes[0], axes.variance[0]),
                             turn_sd(axes.axes[2], axes.axes[0], axes.variance[0]));
  } else {
    shape.orientation = Orientation::plane_like;
    shape.direction = axes.axes[2];
    shape.direction_sd = rms(turn_sd(axes.axes[2], axes.axes[0], axes.variance[0]),
                             turn_sd(axes.axes[2], axes.axes[1], axes.variance[1]));
  }
  shape.direction_sd = std::min(shape.direction_sd, pi / 2);
  // Dissertation 5.2.2: the centre of the box of the endpoints.
  shape.centroid = polyline.segments() == 1 ? Vec3((v[0] + v[1]) / 2) : oriented_box(v).center;
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = 0; j < v.size(); ++j) mean += covariance.block<3, 3>(3 * i, 3 * j);
  shape.centroid_sd = std::sqrt(std::max(0.0, mean.trace() / 3)) / static_cast<double>(v.size());
}

}  // namespace

void set_shape(const Polyline& polyline, const Eigen::MatrixXd& covariance, double mean_edge, FittedShape& shape) {
  ShapeParameter endpoints{"endpoints", 3, {}};
  for (std::size_t i = 0; i < polyline.vertices.size(); ++i) {
    const Vec3& vertex = polyline.vertices[i];
    endpoints.values.insert(endpoints.values.end(), vertex.begin(), vertex.end());
    for (const char* axis : {".x", ".y", ".z"})
      shape.covariance_of.push_back("endpoints[" + std::to_string(i) + "]" + axis);
  }
  shape.parameters = {std::move(endpoints), {"closed", 1, {polyline.closed ? 1.0 : 0.0}}};
  shape.covariance.assign(covariance.data(), covariance.data() + covariance.size());  // symmetric: any order
  set_measures(polyline, covariance, shape);
  set_position(polyline, covariance, shape);
  std::vector<Vec3> path = polyline.vertices;
  if (polyline.closed) path.push_back(path.front());
  shape.outline = resample(path, mean_edge, outline_limit);
  if (polyline.closed && shape.outline.size() > 1) shape.outline.pop_back();
  shape.outline_closed = polyline.closed;
}

void describe(const Polyline& polyline, const FitInput& input, double reach, FittedShape& shape) {
  const double edge = input.mean_edge, diagonal = input.box.diagonal();
  std::vector<double> start(polyline.segments() + 1, 0);
  for (std::size_t k = 0; k < polyline.segments(); ++k) {
    start[k + 1] = start[k] + polyline.length(k);
    if (polyline.length(k) > 1.5 * diagonal) {
      shape.summary.termination = Termination::failed;
      shape.summary.message =
          "segment " + std::to_string(k + 1) + " runs beyond the points: longer than 1.5 box diagonals";
      return;
    }
  }
  const double total = start.back(), per_edge = bins_per_edge / edge;
  const std::size_t bins = static_cast<std::size_t>(std::clamp(std::round(total * per_edge), 1.0, max_bins));
  std::vector<char> filled(bins, 0);
  const auto size = static_cast<Eigen::Index>(3 * polyline.vertices.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  std::size_t inliers = 0;
  double squares = 0;
  for (const Vec3& point : input.points) {
    const Nearest at = nearest(polyline, point);
    if (at.squared > reach * reach) continue;
    ++inliers;
    squares += at.squared;
    const double position = start[at.segment] + at.t * (start[at.segment + 1] - start[at.segment]);
    fill(position / total, edge / total, polyline.closed, filled);
    const std::size_t end[] = {3 * polyline.tail(at.segment), 3 * polyline.head(at.segment)};
    const double share[] = {1 - at.t, at.t};
    const Vec3 along = (polyline.vertices[end[1] / 3] - polyline.vertices[end[0] / 3]).normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) information.block<3, 3>(end[i], end[j]) += share[i] * share[j] * across;
  }
  if (inliers < polyline.vertices.size() || !(total > 0)) {
    shape.summary.termination = Termination::failed;
    shape.summary.message = std::to_string(inliers) + " of " + std::to_string(input.points.size()) +
                            " points lie near the line group: " + std::to_string(polyline.vertices.size()) +
                            " are needed (option 'scale')";
    return;
  }
  const double n = static_cast<double>(inliers);
  shape.rms = std::sqrt(squares / n);
  shape.coverage = static_cast<double>(std::count(filled.begin(), filled.end(), 1)) / static_cast<double>(bins);
  shape.explained = shape.coverage * total / edge;
  shape.unexplained = (static_cast<double>(input.points.size()) - n) / (n / shape.explained);

  // Two components a point; neighbouring vertices err alike, so about one sample per mean edge counts. A free end lies
  // within about an edge of the last point; a corner between segments in one line is known to no better than the box.
  const double rounding = 1e-16 * (input.object_box.diagonal() + polyline.vertices[0].norm());
  const double free_parameters = 3.0 * static_cast<double>(polyline.vertices.size()) - (polyline.closed ? 0 : 2);
  const double variance = std::max(squares / std::max(1.0, 2 * n - free_parameters), rounding * rounding);
  information *= std::min(n, std::max(1.0, shape.explained)) / n / variance;
  information.diagonal().array() += 1 / (diagonal * diagonal);
  if (!polyline.closed) {
    const std::size_t last = polyline.vertices.size() - 1;
    const auto hold = [&](std::size_t end, std::size_t other) {
      const Vec3 along = (polyline.vertices[end] - polyline.vertices[other]).normalized();
      information.block<3, 3>(3 * end, 3 * end) += along * along.transpose() / (edge * edge);
    };
    hold(0, 1);
    hold(last, last - 1);
  }
  const Eigen::MatrixXd covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  set_shape(polyline, covariance, edge, shape);
}

}  // namespace toposcope::line_group
