// SPDX-License-Identifier: BSD-3-Clause
// The cup's table of parameters and what they must keep to.

#include <fmt/format.h>

#include "sample/cup.h"

namespace toposcope {

namespace {

constexpr const char* kind = "cup";

/// Length taken from each leg of a corner of turning angle `turn` by an arc.
double tangent(double radius, double turn) {
  return radius * std::tan(turn / 2);
}

void check_side(const Cup& c) {
  require(std::abs(c.side.lower_slant()) <= pi / 3.5 && std::abs(c.side.upper_slant()) <= pi / 3.5, kind, "top_radius",
          c.top_radius, "the side may lean at most 51 degrees", "bring the radii closer, lower bulge or raise height");
  if (c.side.straight()) return;
  const double at = c.side.middle_height();
  require(at >= 0.2 * c.height && at <= 0.8 * c.height, kind, "bulge_height", at,
          "it must lie between 0.2 and 0.8 height", "choose it in that range");
  require(c.side.arc() >= 1.5 * c.wall, kind, "bulge", c.side.radius(at), "the wall bends too sharply",
          "give a smaller one");
}

void check_foot(const Cup& c) {
  const double turn = pi / 2 - c.side.lower_slant();
  const double inner_line = 0.25 * (c.side.straight() ? c.height : c.side.middle_height());
  require(c.foot >= 0.1 * c.wall, kind, "foot_fillet", c.foot, "it must be at least wall / 10", "give a larger one");
  require(tangent(c.foot, turn) <= 0.9 * c.bottom_radius && tangent(c.foot, turn) <= inner_line, kind, "foot_fillet",
          c.foot, "the rounded foot must leave a flat bottom and a straight side", "give a smaller one");
  require(c.foot * (1 - std::sqrt(0.5)) <= 0.7 * std::min(c.wall, c.bottom), kind, "foot_fillet", c.foot,
          "it must not cut through wall and bottom", "give a smaller one or a thicker wall");
  require(c.inner >= 0.1 * c.wall && tangent(c.inner, turn) <= 0.9 * c.inner_radius(c.floor()) &&
              c.floor() + tangent(c.inner, turn) <= 1.15 * inner_line + 0.2 * c.floor(),
          kind, "inner_fillet", c.inner, "it must be at least wall / 10 and leave a flat bottom and a straight wall",
          "choose it in that range");
  if (!c.has_ring) return;
  require(c.ring_width >= 0.8 * c.wall && c.ring_width <= 0.5 * c.bottom_radius, kind, "ring_width", c.ring_width,
          "it must lie between 0.8 wall and bottom_radius / 2", "choose it in that range");
  require(c.ring_depth <= 0.12 * c.height && c.ring_depth <= 1.5 * c.ring_width, kind, "ring_depth", c.ring_depth,
          "it must be at most 0.12 height and 1.5 ring_width", "give a smaller one");
  require(tangent(c.foot, turn) <= 0.6 * c.ring_width, kind, "foot_fillet", c.foot,
          "the foot ring must be wider than its rounding", "give a smaller one or a wider ring");
}

void check_body(const Cup& c) {
  const double slack = 1 + 1e-9;
  check_side(c);
  require(c.wall >= 0.02 * std::max(2 * c.side.widest(), c.height), kind, "wall", c.wall,
          "the wall must be at least 2 % of the cup's largest side", "give a thicker wall");
  require(c.bottom >= 0.5 * c.wall && c.floor() <= 0.5 * c.height, kind, "bottom_thickness", c.bottom,
          "it must lie between wall / 2 and height / 2", "choose it near wall");
  require(c.lip >= 0.1 * c.wall && c.lip <= 0.5 * c.wall * slack, kind, "lip_radius", c.lip,
          "it must lie between wall / 10 and wall / 2 (fully round)", "choose it in that range");
  require(c.inner_radius(c.floor()) > 0.2 * c.bottom_radius && c.inner_radius(c.height) > 0.2 * c.top_radius, kind,
          "wall", c.wall, "the wall must be thinner than the radius", "give a thinner wall or larger radii");
  check_foot(c);
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
  const double top = c.height - c.wall - around, bottom = std::max(c.foot, c.floor() + c.inner) + around;
  require(c.handle_center + half <= top && c.handle_center - half >= bottom, kind, "handle_center", c.handle_center,
          "both ends of the handle and their fillets must lie between the foot and the lip",
          fmt::format("move the handle or lower handle_height, now from {} to {} where {} to {} is free",
                      c.handle_center - half, c.handle_center + half, bottom, top));
  require(around + c.fillet < 0.7 * c.side.radius(c.handle_center - half) &&
              around + c.fillet < 0.7 * c.side.radius(c.handle_center + half),
          kind, "handle_thickness", c.thickness, "the handle must be narrower than the cup", "give a thinner handle");
  require(handle_gap(c) >= std::max(0.4 * c.thickness, 2.2 * c.fillet), kind, "handle_reach", c.reach,
          "the grip must clear the cup's side by 0.4 handle_thickness and 2.2 handle_fillet",
          "let it reach further, or give a smaller fillet");
}

std::vector<SamplePreset> cup_presets() {
  const auto shape = [](HandleShape s) { return static_cast<double>(s); };
  return {{"mug", "the default: a coffee mug, nearly straight", {}},
          {"teacup",
           "low and wide, round below, on a foot ring, with an ear",
           {{"height", 60},         {"top_radius", 46},
            {"bottom_radius", 26},  {"curved", 1},
            {"bulge", 6},           {"bulge_height", 24},
            {"wall", 2.8},          {"bottom_thickness", 3.2},
            {"lip_radius", 1.2},    {"foot_fillet", 1.2},
            {"inner_fillet", 4},    {"foot_ring", 1},
            {"ring_width", 5},      {"ring_depth", 2.5},
            {"handle_height", 27},  {"handle_reach", 20},
            {"handle_center", 34},  {"handle_thickness", 2.8},
            {"handle_fillet", 1.8}, {"handle_shape", shape(HandleShape::ear)}}},
          {"espresso",
           "small, with a thick wall and a round handle",
           {{"height", 58},
            {"top_radius", 31},
            {"bottom_radius", 23},
            {"wall", 4.2},
            {"bottom_thickness", 6},
            {"lip_radius", 2.1},
            {"foot_fillet", 3},
            {"inner_fillet", 6},
            {"handle_height", 26},
            {"handle_reach", 16},
            {"handle_center", 33},
            {"handle_thickness", 3.6},
            {"handle_fillet", 2.5},
            {"handle_shape", shape(HandleShape::round)}}},
          {"tumbler",
           "a cylinder with sharp edges and a wide square handle",
           {{"height", 100},
            {"top_radius", 43},
            {"bottom_radius", 43},
            {"wall", 3.2},
            {"bottom_thickness", 4},
            {"lip_radius", 0.8},
            {"foot_fillet", 1},
            {"inner_fillet", 2},
            {"handle_height", 62},
            {"handle_reach", 36},
            {"handle_center", 51},
            {"handle_thickness", 6},
            {"handle_fillet", 3},
            {"handle_shape", shape(HandleShape::square)}}},
          {"tall",
           "high and narrow at the foot, with a waist",
           {{"height", 135},
            {"top_radius", 42},
            {"bottom_radius", 33},
            {"curved", 1},
            {"bulge", -4},
            {"bulge_height", 55},
            {"wall", 3.8},
            {"bottom_thickness", 7},
            {"lip_radius", 1.9},
            {"foot_fillet", 4},
            {"inner_fillet", 9},
            {"handle_height", 66},
            {"handle_reach", 30},
            {"handle_center", 74},
            {"handle_thickness", 5.5}}}};
}

std::vector<RandomRange> cup_ranges() {
  return {{"height", 60, 140},
          {"top_radius", 0.3, 0.6, "height"},
          {"bottom_radius", 0.6, 1.05, "top_radius"},
          {"curved", 0, 0.4},
          {"bulge", -0.12, 0.25, "bottom_radius"},
          {"bulge_height", 0.3, 0.65, "height"},
          {"wall", 0.03, 0.06, "height"},
          {"bottom_thickness", 0.8, 1.8, "wall"},
          {"lip_radius", 0.25, 0.5, "wall"},
          {"foot_fillet", 0.3, 1.2, "wall"},
          {"inner_fillet", 0.5, 2.5, "wall"},
          {"foot_ring", 0, 0.3},
          {"ring_width", 0.14, 0.28, "bottom_radius"},
          {"ring_depth", 0.3, 0.9, "wall"},
          {"handle", 0, 0.9},
          {"handle_shape", 0, 3, "", 1},
          {"handle_height", 0.38, 0.6, "height"},
          {"handle_reach", 0.2, 0.36, "height"},
          {"handle_thickness", 0.035, 0.06, "height"},
          {"handle_center", 0.46, 0.58, "height"},
          {"handle_fillet", 0.3, 0.9, "handle_thickness"}};
}

}  // namespace

SampleKind cup_kind() {
  const auto choice = [](const char* name, const char* value, const char* choices, const char* meaning) {
    return OptionRow{name, OptionType::text, "", value, "", "", meaning, choices};
  };
  return {
      "cup",
      "a cup of revolution about z, standing on z = 0, with a handle on the side of +x",
      {length_parameter("height", "95", "0", "height of the cup"),
       length_parameter("top_radius", "41", "0", "outer radius at the top, before the lip is rounded"),
       length_parameter("bottom_radius", "35", "0", "outer radius at the bottom, before the foot is rounded"),
       switch_parameter("curved", "false", "whether the side is curved"),
       length_parameter("bulge", "5", "", "how far a curved side's middle stands out; negative: a waist"),
       length_parameter("bulge_height", "45", "0", "height of that middle"),
       length_parameter("wall", "4", "0", "thickness of the wall, square to it"),
       length_parameter("bottom_thickness", "5", "0", "thickness of the bottom"),
       length_parameter("lip_radius", "2", "0", "radius that rounds both edges of the lip; wall / 2: a half circle"),
       length_parameter("foot_fillet", "3", "0", "radius that rounds the edge of bottom and side"),
       length_parameter("inner_fillet", "6", "0", "radius between the inner wall and the inner bottom"),
       switch_parameter("foot_ring", "false", "whether the cup stands on a ring, its bottom recessed"),
       length_parameter("ring_width", "7", "0", "width of the foot ring"),
       length_parameter("ring_depth", "3", "0", "height of the recessed bottom"),
       switch_parameter("handle", "true", "whether there is a handle"),
       choice("handle_shape", "d", "d|round|ear|square",
              "d: two legs and a grip; round: all one bend; ear: slopes in below; square: sharper bends"),
       length_parameter("handle_height", "54", "0", "distance between the centre lines of the handle's legs"),
       length_parameter("handle_reach", "28", "0", "distance from the wall to the centre line of the grip"),
       length_parameter("handle_thickness", "5", "0", "radius of the handle's round cross-section"),
       length_parameter("handle_center", "50", "0", "height of the middle of the handle"),
       length_parameter("handle_fillet", "4", "0", "radius of the fillet where the handle meets the wall")},
      cup_presets(),
      cup_ranges()};
}

Cup::Cup(const ParameterValues& v)
    : height(parameter(v, "height")),
      top_radius(parameter(v, "top_radius")),
      bottom_radius(parameter(v, "bottom_radius")),
      side(bottom_radius, top_radius, height, parameter(v, "curved") != 0 ? parameter(v, "bulge") : 0,
           parameter(v, "bulge_height")),
      wall(parameter(v, "wall")),
      bottom(parameter(v, "bottom_thickness")),
      lip(parameter(v, "lip_radius")),
      foot(parameter(v, "foot_fillet")),
      inner(parameter(v, "inner_fillet")),
      has_ring(parameter(v, "foot_ring") != 0),
      ring_width(parameter(v, "ring_width")),
      ring_depth(parameter(v, "ring_depth")),
      has_handle(parameter(v, "handle") != 0),
      shape(static_cast<HandleShape>(parameter(v, "handle_shape"))),
      handle_height(parameter(v, "handle_height")),
      reach(parameter(v, "handle_reach")),
      thickness(parameter(v, "handle_thickness")),
      handle_center(parameter(v, "handle_center")),
      fillet(parameter(v, "handle_fillet")) {}

double Cup::inner_radius(double z) const {
  for (const Corner& corner : side.corners(wall, z, height)) return corner.x;
  return 0;
}

void check_cup(const Cup& cup) {
  check_body(cup);
  if (cup.has_handle) check_handle(cup);
}

}  // namespace toposcope
