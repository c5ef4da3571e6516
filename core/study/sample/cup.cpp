// SPDX-License-Identifier: BSD-3-Clause
// A cup: a hollow cone of revolution about z, standing on z = 0, with a D-shaped handle on the side of +x.

#include "sample/cup.h"

#include <Eigen/Geometry>

namespace toposcope {

namespace {

/// The body's section and the places in it that bear features.
struct Section {
  PlanePath path;
  std::size_t foot, lip;  ///< corners: of bottom and side; the outer one of the lip
  double flat;            ///< radius to which the bottom is flat
};

/// \throw UsageError  roundings that leave no room for each other
Section body_section(const Cup& c) {
  std::vector<Corner> corners = {{0, c.recess()}};
  double flat = 0;
  if (c.has_ring) {
    const double inside = c.bottom_radius - c.ring_width;
    const double rounding = std::min(0.3 * c.ring_width, 0.45 * c.ring_depth);
    corners.push_back({inside, c.recess(), rounding});
    corners.push_back({inside, 0, rounding});
    flat = inside - rounding;
  }
  const std::size_t foot = corners.size();
  for (const Corner& corner : c.side.corners(0, 0, c.height)) corners.push_back(corner);
  const std::size_t lip = corners.size() - 1;
  std::vector<Corner> inside = c.side.corners(c.wall, c.floor(), c.height);
  corners.insert(corners.end(), inside.rbegin(), inside.rend());
  corners[foot].radius = c.foot;
  corners[lip].radius = corners[lip + 1].radius = c.lip;
  corners.back().radius = c.inner;
  corners.push_back({0, c.floor()});
  try {
    PlanePath path(corners);
    if (!c.has_ring) flat = path.arc_begin(foot).x();
    return {std::move(path), foot, lip, flat};
  } catch (const std::logic_error&) {
    require(false, "cup", "foot_fillet", c.foot,
            "the roundings of foot, inner bottom, side and lip must leave room for each other", "make one smaller");
    throw;
  }
}

/// What the cup holds, and the room above it.
PlanePath cavity_profile(const Cup& c) {
  std::vector<Corner> corners = {{0, c.floor()}};
  for (const Corner& corner : c.side.corners(c.wall, c.floor(), 1.5 * c.height)) corners.push_back(corner);
  corners[1].radius = c.inner;
  corners.back().x = std::max(corners.back().x, 0.1 * c.top_radius);
  corners.push_back({0, 1.5 * c.height});
  return PlanePath(corners);
}

/// The ring where the fillet is as far from the wall as from the handle, around one end of the handle.
std::vector<Vec3> fillet_ring(const Cup& c, const Solid& solid, const Implicit& body, const Implicit& handle,
                              const Vec3& end, int count) {
  const Implicit between = [&](const Vec3& point) -> Distance {
    const Distance a = body(point), b = handle(point);
    return {a.value - b.value, a.gradient - b.gradient};
  };
  const Vec3 out = body(end).gradient, across = Vec3::UnitY(), up = out.cross(across);
  std::vector<Vec3> ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    const Vec3 start =
        end + (c.thickness + 0.3 * c.fillet) * (std::cos(angle) * up + std::sin(angle) * across) + 0.3 * c.fillet * out;
    ring.push_back(project_to_curve(solid.surface, between, start));
  }
  return ring;
}

/// Centroid of a closed line through points.
Vec3 centroid_of_ring(const std::vector<Vec3>& ring) {
  Vec3 moment = Vec3::Zero();
  double length = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    moment += (b - a).norm() * (a + b) / 2;
    length += (b - a).norm();
  }
  return moment / length;
}

TruthFeature bottom_feature(double radius, double height) {
  TruthFeature feature{"bottom", "plane", {{"point", {0, 0, height}}, {"normal", {0, 0, -1}}}, {}, {}, {}};
  constexpr int count = 40;  // sunflower: an even cover of the disc
  const double golden = pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double r = radius * std::sqrt((i + 0.5) / count);
    feature.points.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), height);
  }
  return feature;
}

TruthFeature handle_feature(const Cup& c, const Solid& solid, const Implicit& body, const Implicit& handle) {
  TruthFeature feature{"handleCon", "line-group", {}, {}, {}, {}};
  std::vector<double> ends;
  for (const bool upper : {true, false}) {
    const double z = c.handle_center + (upper ? 0.5 : -0.5) * c.handle_height;
    const Vec3 end(c.side.radius(z), 0, z);
    ends.insert(ends.end(), {end.x(), end.y(), end.z()});
    constexpr int marks = 32, between = 8;
    const std::vector<Vec3> ring = fillet_ring(c, solid, body, handle, end, marks * between);
    TruthGroup& group = feature.groups.emplace_back();
    group.name = upper ? "upper" : "lower";
    group.centroid = centroid_of_ring(ring);
    for (std::size_t i = 0; i < ring.size(); i += between) {
      group.members.push_back(static_cast<Index>(feature.points.size()));
      feature.points.push_back(ring[i]);
    }
  }
  feature.parameters = {{"endpoints", ends}, {"closed", {0}}};
  return feature;
}

}  // namespace

PlanePath handle_path(const Cup& c) {
  const double low = c.handle_center - c.handle_height / 2, high = c.handle_center + c.handle_height / 2;
  const double grip = c.side.radius(c.handle_center) + c.reach;
  const double near_high = c.side.radius(high), near_low = c.side.radius(low);
  const double leg = grip - std::max(near_high, near_low);
  require(leg > c.thickness + c.fillet, "cup", "handle_reach", c.reach,
          "the grip must clear the widest end of a leaning side", "let it reach further");
  const double most = std::min(c.handle_height / 2, leg);
  const double bend = c.shape == HandleShape::round    ? 0.99 * most
                      : c.shape == HandleShape::square ? std::min(1.3 * c.thickness, 0.85 * most)
                                                       : 0.85 * most;
  const Corner start{0.5 * near_high, high}, end{0.5 * near_low, low};
  if (c.shape != HandleShape::ear) return PlanePath({start, {grip, high, bend}, {grip, low, bend}, end});
  const Vec2 outer(grip, high), lower(near_low + std::max(0.4 * leg, 1.02 * (c.thickness + c.fillet)), low);
  const double slope = std::atan2(c.handle_height, grip - lower.x());  // of the long side that leads back to the cup
  const double length = (outer - lower).norm();
  const double above = std::min(0.9 * leg, 0.6 * length) * std::tan(slope / 2);  // turns by 180 degrees less the slope
  const double below = std::min(0.35 * length, lower.x() - near_low) / std::tan(slope / 2);
  return PlanePath({start, {grip, high, above}, {lower.x(), low, below}, end});
}

double handle_gap(const Cup& c) {
  const PlanePath path = handle_path(c);
  const double length = c.handle_height - 2 * (c.thickness + c.fillet);
  double gap = std::numeric_limits<double>::infinity();
  constexpr int steps = 16;
  for (int i = 4; i <= steps - 4; ++i) {
    const double z = c.handle_center + length * (static_cast<double>(i) / steps - 0.5);
    const Vec2 wall(c.side.radius(z), z);
    gap = std::min(gap, (path.closest(wall).point - wall).norm() - c.thickness);
  }
  return gap;
}

Solid make_cup(const ParameterValues& parameters) {
  const Cup c(parameters);
  check_cup(c);
  const Section section = body_section(c);
  const Implicit body = revolve(section.path, Vec3::Zero(), Vec3::UnitZ());
  const double widest = c.side.widest();
  Solid solid;
  solid.surface = body;
  solid.low = Vec3(-widest, -widest, 0);
  solid.high = Vec3(widest, widest, c.height);
  solid.thinnest = std::min(c.wall, c.bottom);
  solid.thinnest_parameter = c.wall <= c.bottom ? "wall" : "bottom_thickness";
  if (c.has_ring && c.ring_width < solid.thinnest) {
    solid.thinnest = c.ring_width;
    solid.thinnest_parameter = "ring_width";
  }
  solid.gap = c.inner_radius(c.floor());
  solid.part_names = {"body"};
  solid.part_of = [](const Vec3&) { return std::size_t{0}; };

  const Vec2 lip = 0.5 * (section.path.arc_end(section.lip) + section.path.arc_begin(section.lip + 1));
  const Vec2 foot = section.path.crest(section.foot);
  solid.features = {circle_feature("rim", Vec3(0, 0, lip.y()), Vec3::UnitZ(), lip.x()),
                    circle_feature("bottomEdge", Vec3(0, 0, foot.y()), Vec3::UnitZ(), foot.x()),
                    bottom_feature(0.95 * section.flat, c.recess())};
  if (!c.has_handle) {
    solid.features.push_back({"handleCon", "line-group", {}, {}, {}, {}});
    return solid;
  }

  const Implicit tube = sweep(handle_path(c), Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ(), c.thickness);
  // The tube runs on into the cavity, so that it meets the wall as if it went through; the cavity cuts it off there.
  const Implicit cavity = revolve(cavity_profile(c), Vec3::Zero(), Vec3::UnitZ());
  solid.surface = subtract(unite(body, tube, c.fillet), cavity);
  solid.high.x() = std::max(widest, c.side.radius(c.handle_center) + c.reach + c.thickness);
  solid.thinnest = std::min(solid.thinnest, 2 * c.thickness);
  solid.gap = std::min(solid.gap, handle_gap(c));
  solid.part_names = {"body", "handle"};
  solid.part_of = [body, tube, cavity, wall = c.wall](const Vec3& p) -> std::size_t {
    return tube(p).value < body(p).value && cavity(p).value > 0.5 * wall ? 1 : 0;
  };
  solid.features.push_back(handle_feature(c, solid, body, tube));
  return solid;
}

}  // namespace toposcope
