// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Wings, stabilisers and fins: a plane planform swept by balls whose radius is linear from the leading edge to the
// thickest part of the section and from there to the trailing edge. The body is smooth, and its distance exact.

#include <array>
#include <optional>
#include <vector>

#include "sample/implicit.h"
#include "sample/plane_path.h"

namespace toposcope {

/// A trapezoid in a plane: u runs back along the chord, v out along the span.
struct Planform {
  Vec3 origin = Vec3::Zero();  ///< leading edge at the root
  Vec3 u = -Vec3::UnitX(), v = Vec3::UnitY();
  double span = 0;  ///< from root to tip
  double root_chord = 0, tip_chord = 0;
  double sweep = 0;           ///< radians by which the leading edge leans back
  double thickness = 0.15;    ///< of the section, in chords; its thickest part is at 0.3 chords
  double trailing = 0.5;      ///< thickness of the trailing edge, in parts of the section's
  double tip_rounding = 0.3;  ///< of the planform's corners; 0: left as they are, 1: nothing of the tip is straight

  double chord(double along) const { return root_chord + (tip_chord - root_chord) * along / span; }
  double leading_edge(double along) const;  ///< its u
};

class LiftingSurface {
 public:
  /// \pre span, chords and thickness are positive, and the tip is not wholly eaten by its own thickness
  explicit LiftingSurface(const Planform& planform);

  Distance operator()(const Vec3& point) const;

  /// The curve in the planform's plane on which the body ends, from the root along the leading edge, the tip and back
  /// along the trailing edge.
  struct Piece {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    Vec3 center = Vec3::Zero(), begin = Vec3::Zero(), end = Vec3::Zero();  ///< an arc's centre and first and last spoke
    double radius = 0;                                                     ///< 0: straight
    double length = 0;
  };
  std::vector<Piece> outline() const;

  /// Corners in which the lines of leading edge, tip and trailing edge would meet.
  std::array<Vec3, 2> tip_corners() const;

  /// Box that contains the body.
  Vec3 low() const { return low_; }
  Vec3 high() const { return high_; }
  double thinnest() const { return thinnest_; }

 private:
  struct Strip {
    std::vector<Vec2> polygon;  ///< counter-clockwise
    Vec2 base = Vec2::Zero(), slope = Vec2::Zero();
    double radius = 0;  ///< at the base
    double stretch = 1;
    double radius_at(const Vec2& x) const { return radius + slope.dot(x - base); }
    bool contains(const Vec2& x) const;
  };
  struct Rib {  ///< a straight line of balls
    Vec2 from = Vec2::Zero(), along = Vec2::UnitX();
    double length = 0, radius = 0, slope = 0, stretch = 1;
  };
  void add_rib(const Vec2& from, double radius, const Vec2& to, double to_radius);
  Vec3 lift(const Vec2& x) const { return origin_ + x.x() * u_ + x.y() * v_; }

  Vec3 origin_, u_, v_, normal_, low_, high_;
  std::array<Strip, 2> strips_;
  std::vector<Rib> ribs_;
  std::vector<Vec2> boundary_;  ///< from the root of the leading edge around the tip to the root of the trailing edge
  std::vector<double> radii_;
  double tip_line_ = 0;  ///< v at which the body ends
  double thinnest_ = 0;
};

}  // namespace toposcope
