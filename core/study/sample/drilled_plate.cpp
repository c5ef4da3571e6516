// SPDX-License-Identifier: BSD-3-Clause
#include "sample/drilled_plate.h"

#include <algorithm>
#include <cmath>

#include "sample/plane_triangulation.h"

namespace toposcope {

namespace {

enum Part : std::uint8_t { plate_part, hole_part, slot_part, hexagon_part, boss_part };

using Loop = std::vector<Index>;  ///< counter-clockwise seen from above

Vec2 polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Corners of a circle, or of a part of one, both ends included.
void add_arc(const Vec2& center, double radius, double from, double to, int pieces, std::vector<Vec2>& outline) {
  for (int i = 0; i <= pieces; ++i) outline.push_back(center + polar(radius, from + (to - from) * i / pieces));
}

std::vector<Vec2> circle(const Vec2& center, double radius, double turn, int segments) {
  std::vector<Vec2> outline;
  add_arc(center, radius, turn, turn + 2 * pi * (segments - 1) / segments, segments - 1, outline);
  return outline;
}

std::vector<Vec2> slot(const PlateCut& cut, int segments) {
  std::vector<Vec2> outline;
  const Vec2 arm = polar(cut.length / 2, cut.turn);
  add_arc(cut.center + arm, cut.radius, cut.turn - pi / 2, cut.turn + pi / 2, segments / 2, outline);
  add_arc(cut.center - arm, cut.radius, cut.turn + pi / 2, cut.turn + 3 * pi / 2, segments / 2, outline);
  return outline;
}

std::vector<Vec2> edge_of(const DrilledPlate& plate, int segments) {
  const double r = plate.corner_radius, x = plate.length / 2 - r, y = plate.width / 2 - r;
  if (x <= 0 && y <= 0) return circle(Vec2::Zero(), r, 0, segments);
  std::vector<Vec2> outline;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Vec2 center((quarter == 0 || quarter == 3 ? 1 : -1) * x, (quarter < 2 ? 1 : -1) * y);
    add_arc(center, r, quarter * pi / 2, (quarter + 1) * pi / 2, std::max(1, segments / 4), outline);
  }
  return outline;
}

class Tessellation {
 public:
  Tessellation(const DrilledPlate& plate, int segments) : plate_(plate), segments_(segments) {}

  TessellatedSolid make() {
    const std::vector<Vec2> edge = edge_of(plate_, segments_);
    const Loop below = loop(edge, 0), above = loop(edge, plate_.thickness);
    strip(below, above, true, plate_part);
    std::vector<Loop> in_bottom, in_top;
    std::vector<std::vector<Loop>> in_boss(plate_.bosses.size());
    for (const PlateCut& cut : plate_.cuts) {
      const std::size_t boss = boss_around(cut);
      const Loop mouth = cut_through(cut, in_bottom);
      (boss < in_boss.size() ? in_boss[boss] : in_top).push_back(mouth);
    }
    for (std::size_t b = 0; b < plate_.bosses.size(); ++b) {
      const PlateBoss& boss = plate_.bosses[b];
      const std::vector<Vec2> outline = circle(boss.center, boss.radius, boss.turn, segments_);
      const Loop foot = loop(outline, plate_.thickness), top = loop(outline, plate_.thickness + boss.height);
      strip(foot, top, true, boss_part);
      cap(top, in_boss[b], true, boss_part);
      in_top.push_back(foot);
    }
    cap(above, in_top, true, plate_part);
    cap(below, in_bottom, false, plate_part);
    return std::move(made_);
  }

 private:
  Loop loop(const std::vector<Vec2>& outline, double height) {
    Loop made;
    for (const Vec2& p : outline) {
      made.push_back(static_cast<Index>(made_.mesh.positions.size()));
      made_.mesh.positions.emplace_back(p.x(), p.y(), height);
    }
    return made;
  }

  void add(Index a, Index b, Index c, bool as_is, Part part) {
    made_.mesh.triangles.push_back(as_is ? Triangle{a, b, c} : Triangle{a, c, b});
    made_.face_part.push_back(part);
  }

  /// The wall between two loops, seen from outside or from the inside.
  void strip(const Loop& lower, const Loop& upper, bool outwards, Part part) {
    for (std::size_t k = 0; k < lower.size(); ++k) {
      const std::size_t next = (k + 1) % lower.size();
      add(lower[k], lower[next], upper[next], outwards, part);
      add(lower[k], upper[next], upper[k], outwards, part);
    }
  }

  /// The plane face within a loop and around others.
  void cap(const Loop& outer, std::vector<Loop> holes, bool upwards, Part part) {
    std::vector<Vec2> points;
    for (const Vec3& p : made_.mesh.positions) points.emplace_back(p.x(), p.y());
    for (Loop& hole : holes) std::reverse(hole.begin(), hole.end());
    for (const auto& [a, b, c] : triangulate(points, outer, holes)) add(a, b, c, upwards, part);
  }

  std::size_t boss_around(const PlateCut& cut) const {
    std::size_t b = 0;
    while (b < plate_.bosses.size() &&
           (plate_.bosses[b].center - cut.center).norm() + cut.reach() >= plate_.bosses[b].radius)
      ++b;
    return b;
  }

  /// The walls of a cut. \return its mouth
  Loop cut_through(const PlateCut& cut, std::vector<Loop>& in_bottom) {
    const Part part = cut.kind == PlateCut::Kind::round  ? hole_part
                      : cut.kind == PlateCut::Kind::slot ? slot_part
                                                         : hexagon_part;
    const std::vector<Vec2> outline = cut.kind == PlateCut::Kind::slot ? slot(cut, segments_)
                                      : cut.kind == PlateCut::Kind::hexagon
                                          ? circle(cut.center, cut.radius, cut.turn, 6)
                                          : circle(cut.center, cut.radius, cut.turn, segments_);
    const double top = plate_.mouth_height(cut), floor = cut.through() ? 0 : top - cut.depth;
    const double cone = std::max(0.0, cut.countersink - cut.radius);
    const Loop bottom = loop(outline, floor);
    Loop upper = loop(outline, top - cone);
    strip(bottom, upper, false, part);
    if (cut.through())
      in_bottom.push_back(bottom);
    else
      cap(bottom, {}, true, part);
    if (!(cone > 0)) return upper;
    Loop mouth = loop(circle(cut.center, cut.countersink, cut.turn, segments_), top);
    strip(upper, mouth, false, part);
    return mouth;
  }

  const DrilledPlate& plate_;
  int segments_;
  TessellatedSolid made_;
};

/// Every face with corners of its own, as STL has them.
void unweld(TriangleSoup& mesh) {
  std::vector<Vec3> positions;
  for (Triangle& triangle : mesh.triangles)
    for (Index& corner : triangle) {
      positions.push_back(mesh.positions[corner]);
      corner = static_cast<Index>(positions.size() - 1);
    }
  mesh.positions = std::move(positions);
}

std::vector<Vec3> ring(const Vec3& center, double radius, std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 arm = polar(radius, 2 * pi * static_cast<double>(i) / static_cast<double>(count));
    points.emplace_back(center.x() + arm.x(), center.y() + arm.y(), center.z());
  }
  return points;
}

TruthFeature truth_of(const DrilledPlate& plate, const PlateCut& cut) {
  TruthFeature feature{"", "", {}, {}, {}, {}};
  const double top = plate.mouth_height(cut);
  const Vec3 mouth(cut.center.x(), cut.center.y(), top);
  feature.parameters = {{"point", {mouth.x(), mouth.y(), mouth.z()}}, {"axis", {0, 0, 1}}};
  const double depth = cut.through() ? top : cut.depth;
  if (cut.kind != PlateCut::Kind::round) {
    const std::vector<Vec2> outline =
        cut.kind == PlateCut::Kind::slot ? slot(cut, 48) : circle(cut.center, cut.radius, cut.turn, 6);
    for (const Vec2& p : outline) feature.points.emplace_back(p.x(), p.y(), top);
    return feature;
  }
  feature.shape = "cylinder";
  feature.parameters.insert(feature.parameters.end(), {{"radius", {cut.radius}},
                                                       {"depth", {depth}},
                                                       {"through", {cut.through() ? 1.0 : 0.0}},
                                                       {"countersink_radius", {cut.countersink}},
                                                       {"bolt_circle_radius", {cut.bolt_circle}}});
  const double cone = std::max(0.0, cut.countersink - cut.radius);
  for (const double height : {top - cone, top - depth})
    for (const Vec3& p : ring({mouth.x(), mouth.y(), height}, cut.radius, 24)) feature.points.push_back(p);
  return feature;
}

std::vector<TruthFeature> truth_of(const DrilledPlate& plate) {
  std::vector<TruthFeature> features;
  std::map<std::string, int> numbers;
  for (const PlateCut& cut : plate.cuts) {
    TruthFeature& feature = features.emplace_back(truth_of(plate, cut));
    const std::string name = cut.kind == PlateCut::Kind::slot      ? "slot"
                             : cut.kind == PlateCut::Kind::hexagon ? "hexagon"
                                                                   : cut.name;
    feature.name = name == "bore" ? name : name + "[" + std::to_string(++numbers[name]) + "]";
  }
  for (const PlateBoss& boss : plate.bosses) {
    const Vec3 foot(boss.center.x(), boss.center.y(), plate.thickness), top = foot + boss.height * Vec3::UnitZ();
    TruthFeature& feature = features.emplace_back(
        TruthFeature{"boss[" + std::to_string(++numbers["boss"]) + "]", "cylinder", {}, {}, {}, {}});
    feature.parameters = {{"point", {foot.x(), foot.y(), foot.z()}},
                          {"axis", {0, 0, 1}},
                          {"radius", {boss.radius}},
                          {"height", {boss.height}}};
    for (const Vec3& center : {foot, top})
      for (const Vec3& p : ring(center, boss.radius, 24)) feature.points.push_back(p);
  }
  return features;
}

}  // namespace

double DrilledPlate::inset(const Vec2& point) const {
  const Vec2 beyond = point.cwiseAbs() - (Vec2(length, width) / 2 - Vec2::Constant(corner_radius));
  return corner_radius - beyond.cwiseMax(0.0).norm() - std::min(beyond.maxCoeff(), 0.0);
}

double DrilledPlate::mouth_height(const PlateCut& cut) const {
  for (const PlateBoss& boss : bosses)
    if ((boss.center - cut.center).norm() + cut.reach() < boss.radius) return thickness + boss.height;
  return thickness;
}

TessellatedSolid tessellate(const DrilledPlate& plate, int segments) {
  return Tessellation(plate, segments).make();
}

Solid solid_of(const DrilledPlate& plate, int segments, bool unwelded) {
  constexpr int fine_segments = 240;
  Solid solid;
  solid.tessellate = [plate, segments, unwelded](bool fine) {
    TessellatedSolid made = tessellate(plate, fine ? fine_segments : segments);
    if (unwelded && !fine) unweld(made.mesh);
    return made;
  };
  double height = plate.thickness, narrowest = plate.thickness;
  for (const PlateBoss& boss : plate.bosses) height = std::max(height, plate.thickness + boss.height);
  for (const PlateCut& cut : plate.cuts) narrowest = std::min(narrowest, cut.radius);
  solid.low = {-plate.length / 2, -plate.width / 2, 0};
  solid.high = {plate.length / 2, plate.width / 2, height};
  solid.thinnest = std::min(plate.thickness, plate.margin);
  for (const PlateCut& cut : plate.cuts)
    if (!cut.through()) solid.thinnest = std::min(solid.thinnest, plate.mouth_height(cut) - cut.depth);
  solid.gap = narrowest;
  solid.features = truth_of(plate);
  solid.part_names = {"plate", "hole", "slot", "hexagon", "boss"};
  return solid;
}

}  // namespace toposcope
