// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "sample/plane_path.h"
#include "sample/solid.h"

namespace toposcope {

/// Half of an axial section through the outside of a cup: two straight lines and the arc between them.
class CupSide {
 public:
  CupSide(double bottom_radius, double top_radius, double height, double bulge, double bulge_height);

  /// Outer radius at a height, also above and below the cup.
  double radius(double z) const;
  /// Angle by which the lower and the upper line lean outwards.
  double lower_slant() const { return lower_; }
  double upper_slant() const { return upper_; }
  double widest() const;
  /// Radius of the arc between the lines; infinite where they are one.
  double arc() const { return arc_; }
  bool straight() const { return straight_; }
  double middle_height() const { return middle_.y(); }
  bool bulges() const { return lower_ > upper_; }

  /// The side's corners, from the bottom up, a distance within the outside.
  std::vector<Corner> corners(double within, double from, double to) const;

 private:
  double line(double z, double within) const;

  Vec2 bottom_, middle_, top_;
  double lower_ = 0, upper_ = 0, arc_ = 0;
  bool straight_ = true;
};

enum class HandleShape { d, round, ear, square };

struct Cup {
  explicit Cup(const ParameterValues& parameters);

  double height, top_radius, bottom_radius;
  CupSide side;
  double wall, bottom, lip, foot, inner;
  bool has_ring;
  double ring_width, ring_depth;
  bool has_handle;
  HandleShape shape;
  double handle_height, reach, thickness, handle_center, fillet;

  double recess() const { return has_ring ? ring_depth : 0; }
  double floor() const { return recess() + bottom; }  ///< height of the inner bottom
  double inner_radius(double z) const;                ///< of the lines, before roundings
};

/// \throw UsageError  parameters that contradict each other
void check_cup(const Cup& cup);

/// Centre line of the handle in the plane of x and z; starts and ends within the wall.
PlanePath handle_path(const Cup& cup);

/// Least width of the gap between handle and wall.
double handle_gap(const Cup& cup);

}  // namespace toposcope
