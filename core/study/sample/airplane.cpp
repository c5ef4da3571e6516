// SPDX-License-Identifier: BSD-3-Clause
#include "sample/airplane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace toposcope {

namespace {

constexpr const char* kind = "airplane";

double radians(double degrees) {
  return degrees * pi / 180;
}

/// Largest radius of the arc at a corner that takes at most these shares of its legs.
double arc_radius(const Corner& before, const Corner& corner, const Corner& after, double in_share, double out_share) {
  const Vec2 in(corner.x - before.x, corner.y - before.y), out(after.x - corner.x, after.y - corner.y);
  const double turn = std::acos(std::clamp(in.normalized().dot(out.normalized()), -1.0, 1.0));
  return std::min(in_share * in.norm(), out_share * out.norm()) / std::tan(turn / 2);
}

/// A body of revolution from its tail at height 0 up to its nose, both round.
PlanePath spindle(double length, double radius, double nose, double tail, double tail_radius, double nose_radius) {
  std::vector<Corner> corners = {
      {0, 0}, {tail_radius, 0}, {radius, tail}, {radius, length - nose}, {nose_radius, length}, {0, length}};
  constexpr double whole = 0.98, half = 0.5;  // a leg that ends on the axis is the arc's alone
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    corners[i].radius = arc_radius(corners[i - 1], corners[i], corners[i + 1], i == 1 ? whole : half - 0.02,
                                   i + 2 == corners.size() ? whole : half - 0.02);
  return PlanePath(corners);
}

Implicit boxed(const LiftingSurface& surface, double margin) {
  return within_box(surface, surface.low(), surface.high(), margin);
}

/// The outline from where it leaves the rest of the airplane to where it meets it again.
TruthFeature edge_feature(const std::string& name, const LiftingSurface& surface, const Implicit& whole, bool mirrored,
                          std::size_t count) {
  const std::vector<LiftingSurface::Piece> pieces = surface.outline();
  double total = 0;
  for (const auto& piece : pieces) total += piece.length;
  const auto at = [&](double along) {
    for (const auto& piece : pieces) {
      if (along > piece.length && &piece != &pieces.back()) {
        along -= piece.length;
        continue;
      }
      const double t = std::clamp(along / piece.length, 0.0, 1.0);
      if (piece.radius <= 0) return Vec3(piece.from + t * (piece.to - piece.from));
      const double angle = piece.length / piece.radius;  // of the arc: from spoke to spoke
      return Vec3(piece.center + piece.radius / std::sin(angle) *
                                     (std::sin((1 - t) * angle) * piece.begin + std::sin(t * angle) * piece.end));
    }
    return pieces.back().to;
  };
  const double tolerance = 1e-12 * total;
  const auto free = [&](double along) { return whole(at(along)).value > -tolerance; };
  // From a free place towards the root, where the body or a fillet swallows the outline.
  const auto first_free = [&](double inside, double outside) {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (free(middle) ? outside : inside) = middle;
    }
    return outside;
  };
  TruthFeature feature{name, "line-group", {}, {}, {}, {}};
  constexpr int steps = 200;
  int first = 0, last = steps;
  while (first <= steps && !free(total * first / steps)) ++first;
  while (last >= 0 && !free(total * last / steps)) --last;
  if (first >= last) return feature;
  const double from = first == 0 ? 0 : first_free(total * (first - 1) / steps, total * first / steps);
  const double to = last == steps ? total : first_free(total * (last + 1) / steps, total * last / steps);
  for (std::size_t i = 0; i < count; ++i) {
    const double along = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    if (free(along)) feature.points.push_back(at(along));
  }
  const auto [fore, aft] = surface.tip_corners();
  std::vector<double> endpoints;
  for (Vec3 p : {at(from), fore, aft, at(to)}) {
    if (mirrored) p.y() = -p.y();
    endpoints.insert(endpoints.end(), {p.x(), p.y(), p.z()});
  }
  if (mirrored)
    for (Vec3& p : feature.points) p.y() = -p.y();
  feature.parameters = {{"endpoints", endpoints}, {"closed", {0}}};
  return feature;
}

}  // namespace

Airplane::Airplane(const ParameterValues& v)
    : length(parameter(v, "length")),
      radius(parameter(v, "fuselage_radius")),
      nose(parameter(v, "nose_length")),
      tail(parameter(v, "tail_length")),
      tail_radius(parameter(v, "tail_radius")),
      wing_position(parameter(v, "wing_position")),
      wing_height(parameter(v, "wing_height")),
      t_tail(parameter(v, "t_tail") != 0),
      stabilizer_position(parameter(v, "stabilizer_position")),
      fin_position(parameter(v, "fin_position")),
      engines(static_cast<int>(parameter(v, "engines"))),
      rear_engines(parameter(v, "engines_at_rear") != 0),
      engine_radius(parameter(v, "engine_radius")),
      engine_length(parameter(v, "engine_length")),
      engine_station(parameter(v, "engine_station")),
      engine_drop(parameter(v, "engine_drop")),
      fillet(parameter(v, "fillet")) {
  const auto read = [&](Planform& p, const std::string& name, double half) {
    p.span = half * parameter(v, name + (half < 1 ? "_span" : "_height"));
    p.root_chord = parameter(v, name + "_root_chord");
    p.tip_chord = parameter(v, name + "_tip_chord");
    p.sweep = radians(parameter(v, name + "_sweep"));
    p.thickness = parameter(v, half < 1 && name == "wing" ? "wing_thickness" : "tail_thickness");
    p.trailing = parameter(v, "trailing_edge");
    p.tip_rounding = parameter(v, "tip_rounding");
  };
  read(wing, "wing", 0.5);
  read(stabilizer, "stabilizer", 0.5);
  read(fin, "fin", 1);
  const auto across = [](double dihedral) { return Vec3(0, std::cos(dihedral), std::sin(dihedral)); };
  wing.origin = Vec3(-wing_position, 0, wing_height);
  wing.v = across(radians(parameter(v, "wing_dihedral")));
  fin.origin = Vec3(-fin_position, 0, 0);
  fin.v = Vec3::UnitZ();
  stabilizer.v = across(radians(parameter(v, "stabilizer_dihedral")));
  // On top of the fin the stabiliser's chord is centred on the fin's.
  const double above = fin.leading_edge(fin.span) + 0.5 * (fin.tip_chord - stabilizer.root_chord);
  stabilizer.origin = t_tail ? Vec3(-fin_position - above, 0, fin.span - fin.thickness * fin.tip_chord / 2)
                             : Vec3(-stabilizer_position, 0, parameter(v, "stabilizer_height"));
}

double Airplane::fuselage_radius(double behind) const {
  const double taper = (length - behind) / tail;
  return taper >= 1 ? radius : tail_radius + (radius - tail_radius) * std::max(0.0, taper);
}

Vec3 rear_engine(const Airplane& a) {
  const double tail = std::min(a.fin_position, a.t_tail ? a.length : a.stabilizer_position);
  const double behind = 0.5 * (a.wing_position + a.wing.root_chord + tail);
  return {-behind, a.fuselage_radius(behind) + a.engine_drop, 0.3 * a.radius};
}

std::vector<Engine> port_engines(const Airplane& a) {
  std::vector<Engine> engines;
  const PlanePath nacelle = spindle(a.engine_length, a.engine_radius, 0.35 * a.engine_length, 0.5 * a.engine_length,
                                    0.35 * a.engine_radius, 0.6 * a.engine_radius);
  for (int pair = 1; pair <= a.engines / 2; ++pair) {
    Vec3 center, hold;  // middle of the engine; where it is held
    if (a.rear_engines) {
      center = rear_engine(a);
      hold = Vec3(center.x(), 0, center.z());
    } else {
      const double along = a.wing.span * a.engine_station * pair;
      const double lead = a.wing.leading_edge(along);
      hold = a.wing.origin + (lead + 0.3 * a.wing.chord(along)) * a.wing.u + along * a.wing.v;
      center = Vec3(hold.x() + 0.3 * a.wing.chord(along) + 0.1 * a.engine_length, hold.y(), hold.z() - a.engine_drop);
    }
    const Vec3 aft_end = center - 0.5 * a.engine_length * Vec3::UnitX();
    Engine engine;
    engine.surface = revolve(nacelle, aft_end, Vec3::UnitX());
    engine.low = center - Vec3(0.5 * a.engine_length, a.engine_radius, a.engine_radius);
    engine.high = center + Vec3(0.5 * a.engine_length, a.engine_radius, a.engine_radius);
    engine.thinnest = 0.6 * a.engine_radius;
    if (a.engine_drop > a.engine_radius) {
      Planform pylon;
      pylon.root_chord = pylon.tip_chord = 0.55 * a.engine_length;
      pylon.thickness = std::min(0.3, 0.7 * a.engine_radius / pylon.root_chord);
      pylon.tip_rounding = 0;
      if (a.rear_engines) {
        pylon.origin = hold + 0.5 * pylon.root_chord * Vec3::UnitX();
        pylon.v = Vec3::UnitY();
        pylon.span = center.y() + 0.5 * pylon.thickness * pylon.root_chord;
      } else {
        pylon.origin = center + 0.2 * a.engine_length * Vec3::UnitX();
        pylon.v = Vec3::UnitZ();
        pylon.span = a.engine_drop;
        pylon.sweep = std::atan2(std::max(0.0, pylon.origin.x() - hold.x() - 0.5 * pylon.root_chord), pylon.span);
      }
      const LiftingSurface plate(pylon);
      engine.surface = unite(engine.surface, plate, 0.3 * a.engine_radius);
      engine.low = engine.low.cwiseMin(plate.low());
      engine.high = engine.high.cwiseMax(plate.high());
      engine.thinnest = std::min(engine.thinnest, plate.thinnest());
    }
    engines.push_back(engine);
  }
  return engines;
}

double engine_gap(const Airplane& a) {
  const double half_wing = a.wing.thickness * a.wing.chord(a.engine_station * a.wing.span) / 2;
  if (a.engines == 0 || a.engine_drop <= a.engine_radius) return a.radius;  // none, or within the wing
  if (!a.rear_engines) return std::min(a.radius, a.engine_drop - a.engine_radius - half_wing);
  double gap = std::min(a.radius, a.engine_drop - a.engine_radius);
  const LiftingSurface wing(a.wing), stabilizer(a.stabilizer), fin(a.fin);
  const Vec3 middle = rear_engine(a);
  constexpr int steps = 12;
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = middle + a.engine_length * (static_cast<double>(i) / steps - 0.5) * Vec3::UnitX();
    gap = std::min(
        {gap, wing(p).value - a.engine_radius, stabilizer(p).value - a.engine_radius, fin(p).value - a.engine_radius});
  }
  return gap;
}

Solid make_airplane(const ParameterValues& parameters) {
  const Airplane a(parameters);
  check_airplane(a);
  const Implicit body = revolve(spindle(a.length, a.radius, a.nose, a.tail, a.tail_radius, 0.5 * a.radius),
                                Vec3(-a.length, 0, 0), Vec3::UnitX());
  const LiftingSurface wing(a.wing), stabilizer(a.stabilizer), fin(a.fin);
  const double margin = 2 * a.fillet;
  const std::vector<Implicit> parts = {body, boxed(wing, margin), boxed(stabilizer, margin), boxed(fin, margin)};

  Solid solid;
  solid.low = Vec3(-a.length, 0, -a.radius).cwiseMin(wing.low()).cwiseMin(stabilizer.low()).cwiseMin(fin.low());
  solid.high = Vec3(0, 0, a.radius).cwiseMax(wing.high()).cwiseMax(stabilizer.high()).cwiseMax(fin.high());
  solid.thinnest = std::min({wing.thinnest(), stabilizer.thinnest(), fin.thinnest()});
  solid.thinnest_parameter = "trailing_edge";
  solid.part_names = {"body", "wing", "stabilizer", "rudder"};
  Implicit half = unite(unite(unite(body, parts[1], a.fillet), parts[3], a.fillet), parts[2], a.fillet);
  Implicit engines;
  for (const Engine& engine : port_engines(a)) {
    const Implicit near = within_box(engine.surface, engine.low, engine.high, margin);
    engines = engines ? unite(engines, near) : near;
    solid.low = solid.low.cwiseMin(engine.low);
    solid.high = solid.high.cwiseMax(engine.high);
    solid.thinnest = std::min(solid.thinnest, engine.thinnest);
  }
  if (engines) {
    half = unite(half, engines, std::min(a.fillet, 0.3 * a.engine_radius));
    solid.part_names.push_back("engine");
  }
  solid.low.y() = -solid.high.y();
  solid.gap = engine_gap(a);
  solid.surface = mirror_y(half);
  solid.part_of = [parts, engines](const Vec3& point) {
    const Vec3 p(point.x(), std::abs(point.y()), point.z());
    std::size_t best = 0;
    double least = std::abs(parts[0](p).value);
    for (std::size_t i = 1; i <= parts.size(); ++i) {
      if (i == parts.size() && !engines) break;
      const double distance = std::abs(i < parts.size() ? parts[i](p).value : engines(p).value);
      if (distance >= least) continue;
      least = distance;
      best = i;
    }
    return best;
  };
  solid.features = {edge_feature("pWingE", wing, solid.surface, false, 45),
                    edge_feature("sWingE", wing, solid.surface, true, 45),
                    edge_feature("pHzStabE", stabilizer, solid.surface, false, 33),
                    edge_feature("sHzStabE", stabilizer, solid.surface, true, 33),
                    edge_feature("vStabE", fin, solid.surface, false, 33)};
  return solid;
}

}  // namespace toposcope
