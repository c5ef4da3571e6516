// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope::geometry {

using Axes = std::array<Vec3, 3>;

/// Points with their coordinates apart, so that projections run over contiguous numbers.
class Columns {
 public:
  explicit Columns(std::span<const Vec3> points);
  /// Coordinates along an axis; overwritten by the next call of any member.
  const Eigen::ArrayXd& project(const Vec3& axis);
  double width(const Vec3& axis);

 private:
  Eigen::ArrayXd x_, y_, z_, projection_;
};

/// A frame and the volume of the box along it.
struct Candidate {
  Axes axes;
  double volume = std::numeric_limits<double>::infinity();
};

/// Searches frames for the least box around a polyhedron: the convex hull of a few points.
class FrameSearch {
 public:
  /// \param half_extents  of the points along the coordinate axes, all positive: the points do not lie in a plane
  FrameSearch(std::span<const Vec3> points, const Vec3& half_extents);

  std::span<const Vec3> corners() const { return corners_; }
  double width(const Vec3& axis) { return columns_.width(axis); }
  double volume(const Axes& axes) { return width(axes[0]) * width(axes[1]) * width(axes[2]); }

  /// The frame with the given third axis whose rectangle across it is least. One side of that rectangle lies along a
  /// side of the polyhedron's shadow (Freeman and Shapira 1975), and the shadow's sides are the edges between a face
  /// that looks along the axis and one that does not.
  Candidate best_about(const Vec3& axis);

  /// Frames with an axis along the normal of a face, or along a coordinate axis; least volume first. Those of least
  /// lower bound are tried: `enough`, and up to `most` as long as they could still be the best.
  std::vector<Candidate> flush_with_faces(std::size_t enough, std::size_t most);

  /// Turns the frame about one of its axes at a time, each time to the least rectangle, always about the axis that
  /// gains most, until nothing is gained.
  Candidate descend(Candidate current);

  /// Tilts one axis at a time to four sides, by angles (radians) that are halved from `first` down to `last`, and
  /// turns about the tilted axis.
  Candidate polish(Candidate current, double first, double last);

 private:
  struct Edge {
    Index from, to;     ///< corners
    Index left, right;  ///< faces; the left one has its corners counter-clockwise from `from` to `to`
  };
  void build_edges(const std::vector<Triangle>& hull);

  std::vector<Vec3> corners_;
  std::vector<Vec3> areas_;  ///< normals of the faces, as long as their areas
  std::vector<Edge> edges_;
  Columns columns_, area_columns_;
  std::vector<Eigen::Vector2d> shadow_, sides_;  // scratch of best_about, to spare allocations
};

}  // namespace toposcope::geometry
