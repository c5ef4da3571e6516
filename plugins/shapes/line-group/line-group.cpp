// SPDX-License-Identifier: BSD-3-Clause
// Fits connected line segments, open or closed, to working sets (dissertation 4.4.2).

#include <algorithm>
#include <cmath>

#include "polyline.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/shape_parameters.h"
#include "toposcope/plugin.h"

namespace toposcope::line_group {
namespace {

constexpr double longest_segment_diagonals = 1.5;

/// Why the points or arguments determine no line group, or nothing.
std::string obstacle(const FitInput& input, int segments, bool closed, bool centroids) {
  if (!(input.mean_edge > 0)) return "the mean edge length is zero: distances have no scale";
  if (closed && segments < 3) return "a closed line group needs at least 3 segments (argument 'segments')";
  if (centroids && segments != 1) return "ends between centroids need one segment (arguments 'ends', 'segments')";
  if (centroids && input.set_offsets.size() < 3)
    return "ends between centroids need two working sets (argument 'ends')";
  for (std::size_t k = 0; centroids && k + 1 < input.set_offsets.size(); ++k)
    if (input.set_offsets[k] == input.set_offsets[k + 1]) return "a working set is empty";
  if (input.points.size() < static_cast<std::size_t>(segments) + 1)
    return std::to_string(input.points.size()) + " points: " + std::to_string(segments + 1) +
           " are needed for as many endpoints";
  return {};
}

Weight weight_of(const std::string& ends) {
  return ends == "concave" ? Weight::concave : ends == "convex" ? Weight::convex : Weight::area;
}

class LineGroupFitter final : public ShapeFitter {
 public:
  explicit LineGroupFitter(const Options& options)
      : powell_(options.text("method") == "powell"), scale_(options.real("scale")) {}

  FittedShape fit(const FitInput& input, const Options& arguments, Context&) const override {
    FittedShape shape;
    const int segments = arguments.integer("segments");
    const bool closed = arguments.boolean("closed"), centroids = arguments.text("ends") != "extent";
    shape.summary.termination = Termination::degenerate;
    shape.summary.message = obstacle(input, segments, closed, centroids);
    if (!shape.summary.message.empty()) return shape;
    if (centroids) {
      describe_centroids(input, weight_of(arguments.text("ends")), shape);
      return shape;
    }
    const PrincipalAxes axes = principal_axes(input.points);
    const double unit = std::sqrt(axes.variance[0] + axes.variance[1] + axes.variance[2]);
    if (!(unit > 1e-12 * axes.centroid.norm())) {
      shape.summary.message = "the points coincide: no line is determined";
      return shape;
    }
    const double scale = scale_ * input.mean_edge;
    Problem problem{representatives(input.points, axes.centroid, fit_points), input.box, scale / unit,
                    static_cast<std::size_t>(segments), closed};
    for (Vec3& point : problem.points) point = (point - axes.centroid) / unit;
    problem.box.center = (problem.box.center - axes.centroid) / unit;
    for (double& side : problem.box.sides) side /= unit;

    Estimate estimate = segments == 1 ? fit_straight(problem, !powell_)
                        : powell_     ? fit_powell(problem)
                                      : fit_polyline(problem);
    shape.summary = std::move(estimate.summary);
    shape.summary.initial_cost *= unit * unit;
    shape.summary.final_cost *= unit * unit;
    if (!shape.summary.usable()) return shape;
    if (segments == 3 && !closed && !powell_ && input.set_offsets.size() == 3) {
      const auto set = [&](std::size_t k) {
        std::vector<Vec3> points(input.points.begin() + input.set_offsets[k],
                                 input.points.begin() + input.set_offsets[k + 1]);
        for (Vec3& point : points) point = (point - axes.centroid) / unit;
        return points;
      };
      consider_bridge(problem, set(0), set(1), estimate.polyline);
    }
    for (Vec3& vertex : estimate.polyline.vertices) vertex = axes.centroid + unit * vertex;
    trim(estimate.polyline, input.points, 2 * scale);
    order(estimate.polyline);
    describe(estimate.polyline, input, 2 * scale, shape);
    return shape;
  }

  double distance(const FittedShape& shape, const Vec3& point) const override {
    const std::vector<double>& values = parameter_values(shape, "endpoints");
    const std::size_t vertices = values.size() / 3, segments = vertices - (shape.outline_closed ? 0 : 1);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < segments; ++k) {
      const Vec3 tail(&values[3 * k]), head(&values[3 * ((k + 1) % vertices)]);
      least = std::min(least, (closest_on_segment(tail, head, point).point - point).norm());
    }
    return least;
  }

  /// A longer segment is refused as one that has run away from its points.
  Interval bounds(std::string_view measure, std::span<const Box> sets, const Options& arguments) const override {
    if (arguments.text("ends") != "extent" && sets.size() >= 2) {
      const Ends ends(sets.front(), sets.back());
      if (measure == "end_size") return {ends.size, ends.size};
      if (measure == "end_depth") return {ends.depth, ends.depth};
      // A centroid lies within its box.
      const double apart = (sets.back().center - sets.front().center).norm();
      const double reach = (sets.front().diagonal() + sets.back().diagonal()) / 2 * (1 + 1e-9);
      return {apart - reach, apart + reach};
    }
    const double segment = longest_segment_diagonals * enclosing_diameter(sets) * (1 + 1e-9);
    return {0, measure == "length" ? arguments.integer("segments") * segment : segment};
  }

 private:
  bool powell_;
  double scale_;
};

constexpr OptionSpec options[] = {
    {"method", OptionType::text, "", "robust", "", "",
     "robust: many starts, outliers do not count; powell: least squares from the box, as in the dissertation",
     "robust|powell"},
    {"scale", OptionType::real, "mean-edges", "1", "0.05", "20",
     "points within two scales of the line group belong to it"},
};
constexpr OptionSpec arguments[] = {
    {"segments", OptionType::integer, "", "1", "1", "16", "number of line segments"},
    {"closed", OptionType::boolean, "", "false", "", "", "the last endpoint is joined to the first"},
    {"ends", OptionType::text, "", "extent", "", "",
     "one segment ends where the points end; or at the centroids of the first and the last working set's surface, or "
     "of how "
     "much that bends inwards or outwards",
     "extent|centroids|concave|convex"},
};
constexpr ProvidedName measures[] = {
    {"length_#", 1, "length of segment #, from 1"},
    {"length", 1, "sum of the segments' lengths"},
    {"end_size", 1, "ends other than extent: longest side of the two ends' boxes"},
    {"end_depth", 0, "ends other than extent: least of the ends' shortest over longest side"}};

}  // namespace
}  // namespace toposcope::line_group

TOPOSCOPE_PLUGIN(ShapeFitter, toposcope::line_group::LineGroupFitter,
                 {.id = "line-group",
                  .version = "1.1.0",
                  .summary = "connected line segments, open or closed: endpoints and lengths",
                  .citation = "Neal 1999, section 4.4.2",
                  .min_arity = 1,
                  .max_arity = 0,
                  .dimension = 1,
                  .options = toposcope::line_group::options,
                  .arguments = toposcope::line_group::arguments,
                  .provides = toposcope::line_group::measures})
