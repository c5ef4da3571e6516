// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the fit of a polyline minimises.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "polyline.h"

namespace toposcope::line_group {

/// The normal equations over the vertices' coordinates.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
};

/// Per point half the Geman-McClure square of its distance, plus, per piece of polyline, half the square of its
/// distance from the nearest anchor beyond `gap`. Pieces within the gap are free, so that they draw back segments that
/// run away but do not move those that have their points.
class Objective {
 public:
  /// \param anchors  the points that pieces of the polyline are held against
  /// \param width    distance beyond which a point counts less and less
  Objective(std::span<const Vec3> points, std::span<const Vec3> anchors, double width, double gap)
      : points_(points), anchors_(anchors), width_(width), gap_(gap) {}

  double gap() const { return gap_; }

  /// Cost at a polyline; fills in the normal equations where asked for.
  double evaluate(const Polyline& polyline, NormalEquations* equations = nullptr);

 private:
  double pull_of_points(const Polyline& polyline, NormalEquations* equations);
  double pull_of_anchors(const Polyline& polyline, NormalEquations* equations);

  std::span<const Vec3> points_, anchors_;
  double width_, gap_;
  std::vector<Segment> segments_;    // scratch, to spare allocations
  std::vector<std::size_t> beside_;  // of each piece: an anchor near it, the last time
};

/// The objective of polylines whose vertices are some of a few given ones: the cost of a path takes a table's reading.
class PathCosts {
 public:
  PathCosts(std::span<const Vec3> vertices, std::span<const Vec3> points, double width, double gap);
  /// \param path  vertices in their order, none twice
  double of(std::span<const std::size_t> path, bool closed) const;

 private:
  std::size_t pair(std::size_t i, std::size_t j) const { return i * vertices_ + j; }

  std::size_t vertices_, points_;
  double width_;
  std::vector<double> squared_;  // of each pair of vertices, of each point: its distance from their segment
  std::vector<double> beyond_;   // of each pair: what the anchors add
};

}  // namespace toposcope::line_group
