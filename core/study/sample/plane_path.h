// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace toposcope {

using Vec2 = Eigen::Vector2d;

/// A corner of a polyline and the radius of the arc that rounds it. The ends of a path are not rounded.
struct Corner {
  double x = 0, y = 0;
  double radius = 0;
};

/// A plane curve of straight lines and circular arcs, with exact distances: the profile of a solid of revolution
/// (material on its left) or the centre line of a swept tube.
class PlanePath {
 public:
  struct Closest {
    Vec2 point;
    Vec2 normal;         ///< unit, to the right of the path: away from the material
    bool sharp = false;  ///< at a corner without rounding, where the normal is that of the bisector
  };

  /// \throw std::logic_error  an arc does not fit between its neighbours
  explicit PlanePath(const std::vector<Corner>& corners);

  Closest closest(const Vec2& query) const;
  /// Middle of the arc that rounds a corner (its 45-degree point where the corner is a right angle).
  Vec2 crest(std::size_t corner) const { return crests_[corner]; }
  /// Points where the arc of a corner begins and ends.
  Vec2 arc_begin(std::size_t corner) const { return begins_[corner]; }
  Vec2 arc_end(std::size_t corner) const { return ends_[corner]; }

 private:
  struct Element {
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();
    Vec2 normal_from = Vec2::Zero(), normal_to = Vec2::Zero();  ///< at the ends; equal for a line
    Vec2 center = Vec2::Zero();
    double radius = 0;
    double turn = 0;  ///< 0 a line, +1 an arc that turns left (convex material), -1 one that turns right
  };
  /// Between two elements, or an end of the path.
  struct Joint {
    Vec2 point, normal;  ///< the bisecting normal tells the inside at a sharp corner, where both are equally near
    bool sharp;
  };
  void add_line(const Vec2& from, const Vec2& to, double shortest);

  std::vector<Element> elements_;
  std::vector<Joint> joints_;  ///< element i lies between joints i and i + 1
  std::vector<Vec2> crests_, begins_, ends_;
};

}  // namespace toposcope
