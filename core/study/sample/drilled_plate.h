// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Flat plates with holes, as make_plate and make_flange lay them out: their tessellation and their truth.

#include <string>
#include <vector>

#include "sample/solid.h"

namespace toposcope {

/// What is cut into a plate from above.
struct PlateCut {
  enum class Kind { round, slot, hexagon };
  Kind kind = Kind::round;
  Vec2 center = Vec2::Zero();
  double radius = 0;          ///< of a round hole; half of a slot's width; from a hexagon's middle to its corners
  double depth = 0;           ///< below the mouth; 0: through
  double countersink = 0;     ///< radius at the mouth of a cone of 90 degrees; 0: none
  double length = 0;          ///< of a slot, between the middles of its round ends
  double turn = 0;            ///< about its middle, rad: of slot and hexagon, and of the corners of a circle
  double bolt_circle = 0;     ///< radius of the circle of holes that it is one of; 0: none
  std::string name = "hole";  ///< of the feature, numbered where there are several

  bool through() const { return depth == 0; }
  double mouth() const { return std::max(radius, countersink); }
  double reach() const { return kind == Kind::slot ? radius + length / 2 : mouth(); }  ///< of the circle around it
};

/// What stands on a plate: a cylinder, perhaps with a hole through it and the plate.
struct PlateBoss {
  Vec2 center = Vec2::Zero();
  double radius = 0, height = 0;
  double turn = 0;
};

/// It lies on z = 0, its middle at the origin.
struct DrilledPlate {
  std::string kind;
  double length = 0, width = 0, corner_radius = 0;  ///< of a rectangle; a disc is one whose corners are all
  double thickness = 0;
  std::vector<PlateCut> cuts;
  std::vector<PlateBoss> bosses;
  double margin = 0;  ///< least distance of cuts and bosses from each other and from the edge

  /// How far inside of the edge a point lies.
  double inset(const Vec2& point) const;
  /// Height of the face that a cut begins in: of the boss around it, or of the plate.
  double mouth_height(const PlateCut& cut) const;
};

/// \param segments  of a full turn, on circles of any size: their corners lie on the circle, so that chords lie within
TessellatedSolid tessellate(const DrilledPlate& plate, int segments);

/// With a feature for each cut and boss: hole[1], hole[2], ...; slot[1], hexagon[1], boss[1].
Solid solid_of(const DrilledPlate& plate, int segments, bool unwelded);

}  // namespace toposcope
