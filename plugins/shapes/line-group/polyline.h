// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Polylines and the ways to fit them. All work on any scale and in any pose.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "toposcope/geometry/representatives.h"
#include "toposcope/shapes.h"

namespace toposcope::line_group {

constexpr std::size_t fit_points = 400;  ///< of more points so many are fitted

struct Polyline {
  std::vector<Vec3> vertices;
  bool closed = false;  ///< the last vertex is joined to the first

  std::size_t segments() const { return vertices.size() - (closed ? 0 : 1); }
  /// The vertices at the two ends of segment k.
  std::size_t tail(std::size_t k) const { return k; }
  std::size_t head(std::size_t k) const { return k + 1 == vertices.size() ? 0 : k + 1; }
  double length(std::size_t k) const { return (vertices[head(k)] - vertices[tail(k)]).norm(); }
};

/// The point of a polyline nearest to another.
struct Nearest {
  double squared = 0;  ///< distance
  std::size_t segment = 0;
  double t = 0;     ///< position along the segment, 0 to 1
  Vec3 difference;  ///< from the polyline to the point
};
Nearest nearest(const Polyline& polyline, const Vec3& point);

/// A segment, ready for many points.
struct Segment {
  Vec3 tail, along;
  double inverse_length2;
  Segment(const Vec3& from, const Vec3& to) : tail(from), along(to - from) {
    const double length2 = along.squaredNorm();
    inverse_length2 = length2 > 0 ? 1 / length2 : 0;
  }
};
inline Nearest nearest(std::span<const Segment> segments, const Vec3& point) {
  Nearest best;
  best.squared = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Vec3 arm = point - segments[k].tail;
    const double t = std::clamp(arm.dot(segments[k].along) * segments[k].inverse_length2, 0.0, 1.0);
    const Vec3 difference = arm - t * segments[k].along;
    if (const double d2 = difference.squaredNorm(); d2 < best.squared) best = {d2, k, t, difference};
  }
  return best;
}

/// Moves the free ends of an open polyline to the extent of the points within `reach` of their segments' lines.
void trim(Polyline& polyline, std::span<const Vec3> points, double reach);

/// Fixes the order: the longer end segment first; closed: the longest first, then the longer of its neighbours.
void order(Polyline& polyline);

struct Estimate {
  Polyline polyline;
  FitSummary summary;
};

/// What the fits need of the input, in the points' own unit and frame: about the centroid, spread = 1.
struct Problem {
  std::vector<Vec3> points;
  Box box;
  double scale = 0;  ///< distance at which a point may lie from the polyline: one or a few mean edges
  std::size_t segments = 1;
  bool closed = false;
};

/// Distances of the coarse cost: beyond the width a point counts less and less; a piece of polyline may have the gap
/// from `points` points.
double coarse_width(const Problem& problem);
double coarse_gap(const Problem& problem, std::size_t points);

/// Coarse cost of a polyline, from the points to it and from it to the points: what starts compete by.
double two_sided_cost(const Problem& problem, const Polyline& polyline);

/// Initial polylines over the box and the points: U, zig-zag, outlines, paths over extreme points,
/// means of slices and sectors.
std::vector<Polyline> starts(const Problem& problem);

/// One segment: least quantile of squares over lines through two points, then reweighted total least squares.
/// \param search_points  so many are paired
Estimate fit_straight(const Problem& problem, bool robust, std::size_t search_points = 24);

/// Several segments: many starts, Levenberg-Marquardt on the vertices under Geman and McClure's robust distance; parts
/// of the polyline far from every point cost as much as points far from the polyline.
Estimate fit_polyline(const Problem& problem);

/// Three segments over two working sets, each of which is straight: the middle one joins their nearest ends and needs
/// no points. It takes the fitted polyline's place where its cost, from the points to it, is less than half of the
/// other's, from the points to it and back. \param first, second  the points of the sets, in the problem's frame
void consider_bridge(const Problem& problem, std::span<const Vec3> first, std::span<const Vec3> second,
                     Polyline& polyline);

/// Dissertation 4.4.2: Powell's method on the endpoints from the box start of least cost.
Estimate fit_powell(const Problem& problem);

/// Fills in all that follows from the polyline and the points.
/// \param reach  points within it belong to the polyline, mesh unit
void describe(const Polyline& polyline, const FitInput& input, double reach, FittedShape& shape);

/// Parameters, measures, position and outline of a line group from the covariance of its vertices.
void set_shape(const Polyline& polyline, const Eigen::MatrixXd& covariance, double mean_edge, FittedShape& shape);

/// What the points of a working set weigh: the surface that they stand for, or how much that bends inwards or outwards.
/// Where a set of fillets ends hangs on a threshold, and that moves the centroid of its surface; there it bends least.
enum class Weight { area, concave, convex };

/// Segment between the centroids of the first and the last working set (dissertation 3.4.1, Figure 3.5: of the
/// surface).
void describe_centroids(const FitInput& input, Weight weight, FittedShape& shape);

/// What the boxes of the first and the last working set say of a segment between their centroids.
struct Ends {
  Ends(const Box& first, const Box& last);
  double size;   ///< longest side of the two
  double depth;  ///< the lesser of their ratios of shortest to longest side
};

}  // namespace toposcope::line_group
