// SPDX-License-Identifier: BSD-3-Clause
// A cup: a hollow cone of revolution about z, standing on z = 0, with a D-shaped handle on the side of +x.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sample/solid.h"

namespace toposcope {

namespace {

constexpr const char* kind = "cup";

struct Cup {
  explicit Cup(const ParameterValues& v)
      : height(parameter(v, "height")),
        top_radius(parameter(v, "top_radius")),
        bottom_radius(parameter(v, "bottom_radius")),
        wall(parameter(v, "wall")),
        bottom(parameter(v, "bottom_thickness")),
        lip(parameter(v, "lip_radius")),
        foot(parameter(v, "foot_fillet")),
        inner(parameter(v, "inner_fillet")),
        has_handle(parameter(v, "handle") != 0),
        handle_height(parameter(v, "handle_height")),
        reach(parameter(v, "handle_reach")),
        thickness(parameter(v, "handle_thickness")),
        handle_center(parameter(v, "handle_center")),
        fillet(parameter(v, "handle_fillet")) {}

  double height, top_radius, bottom_radius, wall, bottom, lip, foot, inner;
  bool has_handle;
  double handle_height, reach, thickness, handle_center, fillet;

  double slant() const { return std::atan2(top_radius - bottom_radius, height); }
  double outer_radius(double z) const { return bottom_radius + (top_radius - bottom_radius) * z / height; }
  double inner_radius(double z) const { return outer_radius(z) - wall / std::cos(slant()); }
  /// Length taken from each leg of a corner of turning angle `turn` by an arc.
  static double tangent(double radius, double turn) { return radius * std::tan(turn / 2); }
};

void check_body(const Cup& c) {
  const double slack = 1 + 1e-9;
  const double size = 2 * std::max(c.top_radius, c.bottom_radius);
  require(c.wall >= 0.02 * std::max(size, c.height), kind, "wall", c.wall,
          "the wall must be at least 2 % of the cup's largest side", "give a thicker wall");
  require(std::abs(c.slant()) <= pi / 4, kind, "top_radius", c.top_radius, "the side may lean at most 45 degrees",
          "bring top_radius and bottom_radius closer or raise height");
  require(c.bottom >= 0.5 * c.wall && c.bottom <= 0.5 * c.height, kind, "bottom_thickness", c.bottom,
          "it must lie between wall / 2 and height / 2", "choose it near wall");
  require(c.lip >= 0.1 * c.wall && c.lip <= 0.5 * c.wall * slack, kind, "lip_radius", c.lip,
          "it must lie between wall / 10 and wall / 2 (fully round)", "choose it in that range");
  require(c.inner_radius(c.bottom) > 0 && c.inner_radius(c.height) > 0, kind, "wall", c.wall,
          "the wall must be thinner than the radius", "give a thinner wall or larger radii");
  require(c.foot >= 0.1 * c.wall, kind, "foot_fillet", c.foot, "it must be at least wall / 10", "give a larger one");
  const double foot_turn = pi / 2 - c.slant();
  require(Cup::tangent(c.foot, foot_turn) <= 0.9 * c.bottom_radius && Cup::tangent(c.foot, foot_turn) <= 0.4 * c.height,
          kind, "foot_fillet", c.foot, "the rounded foot must leave a flat bottom and a straight side",
          "give a smaller one");
  require(c.foot * (1 - std::sqrt(0.5)) <= 0.7 * std::min(c.wall, c.bottom), kind, "foot_fillet", c.foot,
          "it must not cut through wall and bottom", "give a smaller one or a thicker wall");
  require(c.inner >= 0.1 * c.wall && Cup::tangent(c.inner, foot_turn) <= 0.9 * c.inner_radius(c.bottom) &&
              Cup::tangent(c.inner, foot_turn) <= 0.4 * (c.height - c.bottom),
          kind, "inner_fillet", c.inner, "it must be at least wall / 10 and leave a flat bottom and a straight wall",
          "choose it in that range");
}

void check_handle(const Cup& c) {
  const double half = c.handle_height / 2, around = c.thickness + c.fillet;
  require(c.thickness >= 0.5 * c.wall, kind, "handle_thickness", c.thickness, "it must be at least wall / 2",
          "give a thicker handle");
  require(c.fillet >= 0.1 * c.thickness, kind, "handle_fillet", c.fillet, "it must be at least handle_thickness / 10",
          "give a larger one");
  require(half > around, kind, "handle_height", c.handle_height,
          "half of it must exceed handle_thickness + handle_fillet: the handle needs a hole",
          "give a higher or thinner handle");
  require(c.reach > around + 0.5 * c.thickness, kind, "handle_reach", c.reach,
          "it must exceed 1.5 handle_thickness + handle_fillet: the handle needs a hole", "let it reach further");
  const double top = c.height - c.wall - around, bottom = std::max(c.foot, c.bottom + c.inner) + around;
  require(c.handle_center + half <= top && c.handle_center - half >= bottom, kind, "handle_center", c.handle_center,
          "both ends of the handle and their fillets must lie between the foot and the lip",
          "move the handle or lower handle_height, now from " + std::to_string(c.handle_center - half) + " to " +
              std::to_string(c.handle_center + half) + " where " + std::to_string(bottom) + " to " +
              std::to_string(top) + " is free");
  require(around + c.fillet < 0.7 * c.outer_radius(c.handle_center - half) &&
              around + c.fillet < 0.7 * c.outer_radius(c.handle_center + half),
          kind, "handle_thickness", c.thickness, "the handle must be narrower than the cup", "give a thinner handle");
}

PlanePath body_profile(const Cup& c) {
  return PlanePath({{0, 0},
                    {c.bottom_radius, 0, c.foot},
                    {c.top_radius, c.height, c.lip},
                    {c.inner_radius(c.height), c.height, c.lip},
                    {c.inner_radius(c.bottom), c.bottom, c.inner},
                    {0, c.bottom}});
}

/// What the cup holds, and the room above it.
PlanePath cavity_profile(const Cup& c) {
  const double above = 2 * c.height;
  return PlanePath(
      {{0, c.bottom}, {c.inner_radius(c.bottom), c.bottom, c.inner}, {c.inner_radius(above), above}, {0, above}});
}

/// Two legs square to the axis and a grip along it, rounded; starts and ends within the cup.
PlanePath handle_path(const Cup& c) {
  const double low = c.handle_center - c.handle_height / 2, high = c.handle_center + c.handle_height / 2;
  const double grip = c.outer_radius(c.handle_center) + c.reach;
  const double leg = grip - std::max(c.outer_radius(low), c.outer_radius(high));
  require(leg > c.thickness + c.fillet, kind, "handle_reach", c.reach,
          "the grip must clear the widest end of a leaning side", "let it reach further");
  const double bend = std::min(c.handle_height / 2, leg) * 0.85;
  return PlanePath(
      {{0.5 * c.outer_radius(high), high}, {grip, high, bend}, {grip, low, bend}, {0.5 * c.outer_radius(low), low}});
}

/// The ring where the fillet is as far from the wall as from the handle, around one end of the handle.
std::vector<Vec3> fillet_ring(const Cup& c, const Solid& solid, const Implicit& body, const Implicit& handle,
                              const Vec3& end) {
  const Implicit between = [&](const Vec3& point) -> Distance {
    const Distance a = body(point), b = handle(point);
    return {a.value - b.value, a.gradient - b.gradient};
  };
  const Vec3 out = body(end).gradient, across = Vec3::UnitY(), up = out.cross(across);
  std::vector<Vec3> ring;
  constexpr int count = 32;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    const Vec3 start =
        end + (c.thickness + 0.3 * c.fillet) * (std::cos(angle) * up + std::sin(angle) * across) + 0.3 * c.fillet * out;
    ring.push_back(project_to_curve(solid.surface, between, start));
  }
  return ring;
}

SampleFeature bottom_feature(double radius) {
  SampleFeature feature{"bottom", "plane", {{"point", {0, 0, 0}}, {"normal", {0, 0, -1}}}, {}, {}, {}};
  constexpr int count = 40;  // sunflower: an even cover of the disc
  const double golden = pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double r = radius * std::sqrt((i + 0.5) / count);
    feature.points.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), 0);
  }
  return feature;
}

SampleFeature handle_feature(const Cup& c, const Solid& solid, const Implicit& body, const Implicit& handle) {
  SampleFeature feature{"handleCon", "line-group", {}, {}, {}, {}};
  std::vector<double> ends;
  for (const bool upper : {true, false}) {
    const double z = c.handle_center + (upper ? 0.5 : -0.5) * c.handle_height;
    const Vec3 end(c.outer_radius(z), 0, z);
    ends.insert(ends.end(), {end.x(), end.y(), end.z()});
    const std::vector<Vec3> ring = fillet_ring(c, solid, body, handle, end);
    std::vector<Index> members;
    for (const Vec3& point : ring) {
      members.push_back(static_cast<Index>(feature.points.size()));
      feature.points.push_back(point);
    }
    feature.groups.emplace_back(upper ? "upper" : "lower", std::move(members));
  }
  feature.parameters = {{"endpoints", ends}, {"closed", {0}}};
  return feature;
}

}  // namespace

SampleKind cup_kind() {
  return {
      "cup",
      "a cup of revolution about z, standing on z = 0, with a handle on the side of +x",
      {length_parameter("height", "95", "0", "height of the cup"),
       length_parameter("top_radius", "41", "0", "outer radius at the top, before the lip is rounded"),
       length_parameter("bottom_radius", "35", "0", "outer radius at the bottom, before the foot is rounded"),
       length_parameter("wall", "4", "0", "thickness of the wall, square to it"),
       length_parameter("bottom_thickness", "5", "0", "thickness of the bottom"),
       length_parameter("lip_radius", "2", "0", "radius that rounds both edges of the lip; wall / 2: a half circle"),
       length_parameter("foot_fillet", "3", "0", "radius that rounds the edge of bottom and side"),
       length_parameter("inner_fillet", "6", "0", "radius between the inner wall and the inner bottom"),
       switch_parameter("handle", "true", "whether there is a handle"),
       length_parameter("handle_height", "54", "0", "distance between the centre lines of the handle's legs"),
       length_parameter("handle_reach", "28", "0", "distance from the wall to the centre line of the grip"),
       length_parameter("handle_thickness", "5", "0", "radius of the handle's round cross-section"),
       length_parameter("handle_center", "50", "0", "height of the middle of the handle"),
       length_parameter("handle_fillet", "4", "0", "radius of the fillet where the handle meets the wall")}};
}

Solid make_cup(const ParameterValues& parameters) {
  const Cup c(parameters);
  check_body(c);
  if (c.has_handle) check_handle(c);

  const PlanePath profile = body_profile(c);
  const Implicit body = revolve(profile, Vec3::Zero(), Vec3::UnitZ());
  const double widest = std::max(c.top_radius, c.bottom_radius);
  Solid solid;
  solid.surface = body;
  solid.low = Vec3(-widest, -widest, 0);
  solid.high = Vec3(widest, widest, c.height);
  solid.thinnest = std::min(c.wall, c.bottom);
  solid.thinnest_parameter = c.wall <= c.bottom ? "wall" : "bottom_thickness";
  solid.part_names = {"body"};
  solid.part_of = [](const Vec3&) { return std::size_t{0}; };

  const Vec2 lip = 0.5 * (profile.arc_end(2) + profile.arc_begin(3));
  const Vec2 foot = profile.crest(1);
  solid.features = {circle_feature("rim", Vec3(0, 0, lip.y()), Vec3::UnitZ(), lip.x()),
                    circle_feature("bottomEdge", Vec3(0, 0, foot.y()), Vec3::UnitZ(), foot.x()),
                    bottom_feature(0.95 * profile.arc_begin(1).x())};
  if (!c.has_handle) {
    solid.features.push_back({"handleCon", "line-group", {}, {}, {}, {}});
    return solid;
  }

  const Implicit tube = sweep(handle_path(c), Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ(), c.thickness);
  // The tube runs on into the cavity, so that it meets the wall as if it went through; the cavity cuts it off there.
  const Implicit cavity = revolve(cavity_profile(c), Vec3::Zero(), Vec3::UnitZ());
  solid.surface = subtract(unite(body, tube, c.fillet), cavity);
  solid.high.x() = std::max(widest, c.outer_radius(c.handle_center) + c.reach + c.thickness);
  solid.thinnest = std::min(solid.thinnest, 2 * c.thickness);
  solid.part_names = {"body", "handle"};
  solid.part_of = [body, tube, cavity, wall = c.wall](const Vec3& p) -> std::size_t {
    return tube(p).value < body(p).value && cavity(p).value > 0.5 * wall ? 1 : 0;
  };
  solid.features.push_back(handle_feature(c, solid, body, tube));
  return solid;
}

}  // namespace toposcope
