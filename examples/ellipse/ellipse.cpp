// SPDX-License-Identifier: BSD-3-Clause
// Fits an ellipse in space: a plane, then orthogonal distances in it.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "plane_ellipse.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;
using ellipse::PlaneEllipse;
using ellipse::Vec2;

constexpr std::size_t outline_limit = 512;
constexpr double longest = 2;  // an ellipse larger than so many boxes of its points is a guess

class EllipseFitter final : public ShapeFitter {
 public:
  explicit EllipseFitter(const Options& options) : scale_(options.real("scale")) {}

  FittedShape fit(const FitInput& input, const Options&, Context&) const override {
    FittedShape shape;
    shape.summary.termination = Termination::degenerate;
    shape.summary.message = "fewer than six points, or points on a line: no ellipse is determined";
    if (input.points.size() < 6 || !(input.mean_edge > 0)) return shape;
    const PrincipalAxes axes = principal_axes(input.points);
    const double spread = std::sqrt(axes.variance[0]);
    if (!(axes.variance[1] > 1e-6 * axes.variance[0]) || !(spread > 1e-12 * axes.centroid.norm())) return shape;

    std::vector<Vec2> flat;
    flat.reserve(input.points.size());
    for (const Vec3& p : input.points) {
      const Vec3 arm = (p - axes.centroid) / spread;
      flat.emplace_back(arm.dot(axes.axes[0]), arm.dot(axes.axes[1]));
    }
    const auto start = ellipse::direct_fit(flat);
    shape.summary.message = "the points lie on no ellipse";
    if (!start) return shape;
    const double scale = scale_ * input.mean_edge;
    const ellipse::Refined refined = ellipse::refine(flat, *start, 0.1 * scale / spread);
    shape.summary.iterations = refined.iterations;
    if (!refined.converged) {
      shape.summary.termination = Termination::iteration_limit;
      shape.summary.message = "no convergence; the points are far from an ellipse";
      return shape;
    }
    if (refined.ellipse.a * spread > longest * input.box.diagonal()) {
      shape.summary.message = "the arc is too short: many ellipses fit it as well";
      return shape;
    }
    describe(refined, flat, axes, input, 2 * scale, shape);
    return shape;
  }

  double distance(const FittedShape& shape, const Vec3& point) const override {
    const auto vector = [&](const char* name) { return Vec3(shape.parameter(name)->values.data()); };
    const Vec3 normal = vector("normal"), major = vector("axis"), arm = point - vector("center");
    const PlaneEllipse plane{Vec2::Zero(), shape.measure("semi_major")->value, shape.measure("semi_minor")->value, 0};
    const Vec2 in_plane(arm.dot(major), arm.dot(normal.cross(major)));
    return std::hypot((in_plane - plane.at(ellipse::nearest(plane, in_plane))).norm(), arm.dot(normal));
  }

  Interval bounds(std::string_view measure, std::span<const Box> sets, const Options&) const override {
    if (measure == "flattening") return {0, 1};
    return {0, longest * enclosing_diameter(sets) * (1 + 1e-9)};
  }

 private:
  /// All that follows from the ellipse. \param reach  points within it belong to the ellipse, mesh unit
  static void describe(const ellipse::Refined& refined, const std::vector<Vec2>& flat, const PrincipalAxes& axes,
                       const FitInput& input, double reach, FittedShape& shape) {
    const double spread = std::sqrt(axes.variance[0]), edge = input.mean_edge;
    const PlaneEllipse& plane = refined.ellipse;
    // In space: the frame of the plane, right-handed.
    const Vec3 u = axes.axes[0], v = axes.axes[1], normal = u.cross(v);
    const auto lift = [&](const Vec2& x) { return Vec3(axes.centroid + spread * (x.x() * u + x.y() * v)); };
    const double a = spread * plane.a, b = spread * plane.b;
    const Vec3 center = lift(plane.center);
    const Vec3 major = std::cos(plane.angle) * u + std::sin(plane.angle) * v;

    constexpr std::size_t bins = 360;
    std::vector<char> seen(bins, 0);
    double flat_squares = 0, high_squares = 0, inliers = 0;  // in the plane and off it
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const double t = ellipse::nearest(plane, flat[i]);
      const double aside = spread * (flat[i] - plane.at(t)).norm(), high = (input.points[i] - center).dot(normal);
      if (std::hypot(aside, high) > reach) continue;
      flat_squares += aside * aside;
      high_squares += high * high;
      ++inliers;
      // A point stands for half an edge of arc to both sides.
      const double speed = std::hypot(a * std::sin(t), b * std::cos(t)), half = std::min(pi, edge / speed);
      for (double s = t - half; s <= t + half; s += 2 * pi / bins)
        seen[static_cast<std::size_t>(std::floor((s + 4 * pi) / (2 * pi) * bins)) % bins] = 1;
    }
    if (inliers < 6) {
      shape.summary = {Termination::failed, "fewer than six points lie near the ellipse (option 'scale')", 0, 0, 0};
      return;
    }
    std::vector<Vec3> line;
    double length = 0, covered = 0;
    for (std::size_t k = 0; k <= bins; ++k) line.push_back(lift(plane.at(2 * pi * static_cast<double>(k) / bins)));
    for (std::size_t k = 0; k < bins; ++k) {
      const double piece = (line[k + 1] - line[k]).norm();
      length += piece;
      covered += seen[k] ? piece : 0;
    }

    const double squares = flat_squares + high_squares;
    shape.rms = std::sqrt(squares / inliers);
    shape.explained = covered / edge;
    shape.unexplained = shape.explained * (static_cast<double>(flat.size()) - inliers) / inliers;
    shape.coverage = std::min(1.0, covered / length);
    // One independent sample per edge of arc, though there may be several points.
    const double per_sample = std::max(1.0, inliers / std::max(1.0, shape.explained));
    const auto noise = [&](double sum, double parameters) {
      return std::max(sum / std::max(1.0, inliers - parameters), std::pow(1e-9 * a, 2)) * per_sample;
    };
    const double variance = noise(flat_squares, 5), high_variance = noise(high_squares, 3);
    const ellipse::Mat5 normal_matrix =
        refined.normal + 1e-9 * refined.normal.trace() * ellipse::Mat5::Identity();  // as in the fit
    const ellipse::Mat5 covariance = variance * normal_matrix.inverse();
    const double semi_sd[] = {std::sqrt(covariance(2, 2)), std::sqrt(covariance(3, 3))};
    shape.covariance_of = {"center.u", "center.v", "semi_major", "semi_minor"};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) shape.covariance.push_back(covariance(i, j));

    const auto list = [](const Vec3& x) { return std::vector<double>{x.x(), x.y(), x.z()}; };
    shape.parameters = {{"center", 3, list(center)},
                        {"normal", 3, list(normal)},
                        {"axis", 3, list(major)},
                        {"semi_major", 1, {a}},
                        {"semi_minor", 1, {b}}};
    shape.measures = {{"semi_major", a, semi_sd[0]},
                      {"semi_minor", b, semi_sd[1]},
                      {"flattening", 1 - b / a, std::hypot(semi_sd[1], semi_sd[0] * b / a) / a}};
    shape.orientation = Orientation::plane_like;
    shape.direction = normal;
    shape.direction_sd =
        std::min(pi / 2, std::sqrt(high_variance / inliers / 2 * (1 / axes.variance[0] + 1 / axes.variance[1])));
    shape.centroid = center;
    shape.centroid_sd = std::sqrt((covariance(0, 0) + covariance(1, 1) + high_variance / inliers) / 3);
    shape.outline = resample(line, edge, outline_limit);
    if (shape.outline.size() > 1) shape.outline.pop_back();  // the first point again
    shape.outline_closed = true;
    shape.summary = {Termination::converged, "", refined.iterations, squares / 2, squares / 2};
  }

  double scale_;
};

constexpr OptionSpec options[] = {
    {"scale", OptionType::real, "mean-edges", "1", "0.05", "20",
     "points within two scales of the ellipse belong to it"},
};

constexpr ProvidedName measures[] = {
    {"semi_major", 1, "half of the longest diameter"},
    {"semi_minor", 1, "half of the shortest diameter"},
    {"flattening", 0, "1 - semi_minor / semi_major; 0 for a circle"},
};

}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, EllipseFitter,
                 {.id = "ellipse",
                  .version = "1.0.0",
                  .summary = "ellipse: centre, normal, direction of the long axis and both semi-axes",
                  .citation = "Halir and Flusser 1998 (start); Ahn 2004 (orthogonal distances)",
                  .min_arity = 1,
                  .dimension = 1,
                  .options = options,
                  .provides = measures})
