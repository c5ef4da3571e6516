// SPDX-License-Identifier: BSD-3-Clause
#include "sample/fitting.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace toposcope {

namespace {

std::vector<Pipe> all_pipes(const Fitting& t) {
  std::vector<Pipe> pipes;
  for (const Run& run : t.runs) pipes.insert(pipes.end(), run.pipes.begin(), run.pipes.end());
  return pipes;
}

/// How much longer than wide the corner of two pipes of one radius is: cotangent of half the angle between them.
double slenderness(const Vec3& a, const Vec3& b) {
  const double c = a.dot(b);
  return std::sqrt((1 + c) / std::max(1 - c, 1e-12));
}

/// Least length of a pipe that leaves room for the others, the fillet and the socket.
double clear_length(const Fitting& t, const Pipe& pipe) {
  double room = t.outer();
  for (const Pipe& other : all_pipes(t))
    if (other.rim != pipe.rim)
      room = std::max(room, (t.hub() + t.fillet) * std::max(0.0, slenderness(pipe.direction, other.direction)));
  if (t.bend) room = *t.bend + 1.3 * (t.hub() - t.outer());  // the socket's cone and its rounding
  return room + t.hub_length() + (t.has_socket ? 0 : 2 * t.edge);
}

void check(const Fitting& t) {
  const std::string& kind = t.kind;
  double longest = 0;
  for (const Pipe& pipe : all_pipes(t)) longest = std::max(longest, pipe.length / pipe.per_length);
  require(t.wall >= 0.015 * longest && t.wall >= 0.05 * t.bore, kind, "wall", t.wall,
          "the wall must be at least 1.5 % of the fitting's length and 5 % of its bore radius", "give a thicker wall");
  require(t.wall <= 2 * t.bore, kind, "wall", t.wall, "the wall may be at most twice bore_radius",
          "give a thinner wall or a wider bore");
  require(t.edge >= 0.1 * t.wall && t.edge <= 0.45 * t.wall, kind, "edge_rounding", t.edge,
          "it must lie between 0.1 and 0.45 wall", "choose it in that range");
  if (!t.bend)
    require(t.fillet >= 0.1 * t.wall && t.fillet <= 0.8 * t.outer(), kind, "fillet", t.fillet,
            "it must lie between wall / 10 and 0.8 (bore_radius + wall)", "choose it in that range");
  else
    require(*t.bend >= 1.2 * t.outer(), kind, "bend_radius", *t.bend, "it must be at least 1.2 (bore_radius + wall)",
            "give a larger one, or mitred=true");
  if (t.has_socket) {
    require(t.socket >= t.bore + 0.2 * t.wall && t.socket <= 2 * t.bore, kind, "socket_radius", t.socket,
            "it must lie between bore_radius + wall / 5 and 2 bore_radius", "choose it in that range");
    require(t.depth >= t.wall, kind, "socket_depth", t.depth, "it must be at least wall", "give a deeper socket");
  }
  for (const Pipe& pipe : all_pipes(t)) {
    const double clear = clear_length(t, pipe);
    require(
        pipe.length >= clear * (1 - 1e-12), kind, pipe.length_parameter, pipe.length / pipe.per_length,
        fmt::format("it must leave room for bends, other pipes, fillets and sockets, which take {} on the way to {}",
                    clear, pipe.rim),
        "make it longer, or the fillet or socket smaller");
  }
}

/// Outer skin of one pipe, from `start` out. Its inner end is a half ball that lies within the other pipes and touches
/// them smoothly: a flat end would make a false corner there.
Implicit pipe_skin(const Fitting& t, const Pipe& pipe, double start) {
  std::vector<Corner> corners = {{0, start - t.outer()}, {t.outer(), start - t.outer(), t.outer()}};
  if (t.has_socket) {
    const double step = pipe.length - t.hub_length();
    const double rounding = std::min(t.wall, 0.4 * (t.hub() - t.outer()));
    corners.push_back({t.outer(), step - (t.hub() - t.outer()), rounding});  // a cone of 45 degrees
    corners.push_back({t.hub(), step, rounding});
  }
  corners.push_back({t.hub(), pipe.length, t.edge});
  corners.push_back({0, pipe.length});
  return revolve(PlanePath(corners), Vec3::Zero(), pipe.direction);
}

/// Bore of one pipe, open beyond its end.
Implicit pipe_bore(const Fitting& t, const Pipe& pipe, double start) {
  const double beyond = pipe.length + t.hub();
  std::vector<Corner> corners = {{0, start - t.bore}, {t.bore, start - t.bore, t.bore}};
  if (t.has_socket) {
    const double rounding = std::min(t.edge, 0.4 * (t.socket - t.bore));
    corners.push_back({t.bore, pipe.length - t.depth, rounding});
    corners.push_back({t.socket, pipe.length - t.depth, rounding});
  }
  corners.push_back({t.mouth(), beyond});
  corners.push_back({0, beyond});
  return revolve(PlanePath(corners), Vec3::Zero(), pipe.direction);
}

/// Two pipes at right angles and the arc between them: a part of a torus, between the planes where the pipes begin.
Implicit bent(const Implicit& first, const Implicit& second, const Vec3& u, const Vec3& v, double bend, double radius) {
  return [=, w = u.cross(v).eval()](const Vec3& p) -> Distance {
    const double x = p.dot(u) - bend, y = p.dot(v) - bend, z = p.dot(w);
    if (x >= 0 && y >= 0) {
      const Distance a = first(p), b = second(p);
      return a.value <= b.value ? a : b;
    }
    if (x >= 0) return first(p);
    if (y >= 0) return second(p);
    const double out = std::hypot(x, y), across = out - bend, length = std::hypot(across, z);
    if (out <= 0 || length <= 0) return {-radius, w};
    return {length - radius, across / (length * out) * (x * u + y * v) + z / length * w};
  };
}

struct Skins {
  Implicit skin, bore;
};

Skins make_run(const Fitting& t, const Run& run) {
  const double start = t.bend.value_or(0);
  std::vector<Skins> pipes;
  for (const Pipe& pipe : run.pipes) pipes.push_back({pipe_skin(t, pipe, start), pipe_bore(t, pipe, start)});
  if (pipes.size() == 1) return pipes[0];
  if (!t.bend) return {unite(pipes[0].skin, pipes[1].skin), unite(pipes[0].bore, pipes[1].bore)};
  const Vec3 &u = run.pipes[0].direction, &v = run.pipes[1].direction;
  return {bent(pipes[0].skin, pipes[1].skin, u, v, *t.bend, t.outer()),
          bent(pipes[0].bore, pipes[1].bore, u, v, *t.bend, t.bore)};
}

/// Across the bore, and from the sockets, which stand out, to the pipes beside them.
double narrowest_gap(const Fitting& t) {
  double gap = t.bore;
  if (!t.has_socket) return gap;
  for (const Pipe& a : all_pipes(t))
    for (const Pipe& b : all_pipes(t)) {
      if (std::abs(a.direction.dot(b.direction)) > 0.99) continue;
      const Implicit other = pipe_skin(t, b, t.bend.value_or(0));
      const Vec3 aside = t.hub() * (b.direction - b.direction.dot(a.direction) * a.direction).normalized();
      constexpr int steps = 8;
      for (int i = 0; i <= steps; ++i) {
        const Vec3 p = (a.length - t.hub_length() * i / steps) * a.direction + aside;
        gap = std::min(gap, other(p).value);
      }
    }
  return gap;
}

TruthFeature rim(const Fitting& t, const Pipe& pipe) {
  const double inset = t.edge * (1 - std::sqrt(0.5));  // the rounded edge's 45-degree point
  TruthFeature feature =
      circle_feature(pipe.rim, (pipe.length - inset) * pipe.direction, pipe.direction, t.hub() - inset);
  feature.parameters.push_back({"band", {t.mouth(), t.hub()}});
  return feature;
}

/// The run whose skin or bore is nearest, of equals the one that the point does not lie behind.
std::function<std::size_t(const Vec3&)> nearest_run(const Fitting& t, const std::vector<Skins>& skins) {
  return [runs = t.runs, skins](const Vec3& p) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t r = 0; r < runs.size(); ++r) {
      double behind = std::numeric_limits<double>::infinity();
      for (const Pipe& pipe : runs[r].pipes) behind = std::min(behind, std::max(0.0, -p.dot(pipe.direction)));
      const double distance = std::min(std::abs(skins[r].skin(p).value), std::abs(skins[r].bore(p).value)) + behind;
      if (distance >= least) continue;
      least = distance;
      best = r;
    }
    return best;
  };
}

}  // namespace

SampleKind fitting_kind(const std::string& name, const std::string& summary, const std::vector<OptionRow>& lengths,
                        const std::map<std::string, double>& socketed, const std::vector<RandomRange>& ranges) {
  std::vector<OptionRow> rows = {length_parameter("bore_radius", "16", "0", "inner radius of the pipes"),
                                 length_parameter("wall", "4", "0", "thickness of the wall")};
  rows.insert(rows.end(), lengths.begin(), lengths.end());
  rows.push_back(switch_parameter("socket", "false", "whether the openings are widened to sockets"));
  rows.push_back(length_parameter("socket_radius", "19", "0", "inner radius of a socket"));
  rows.push_back(length_parameter("socket_depth", "16", "0", "depth of a socket"));
  rows.push_back(length_parameter("fillet", "6", "0", "radius of the fillet where pipes meet"));
  rows.push_back(length_parameter("edge_rounding", "1", "0", "radius that rounds the edges of the openings"));
  std::map<std::string, double> with_sockets = socketed;
  with_sockets["socket"] = 1;
  std::vector<RandomRange> all = {{"bore_radius", 5, 50},
                                  {"wall", 0.18, 0.4, "bore_radius"},
                                  {"socket", 0, 0.4},
                                  {"socket_radius", 1.1, 1.25, "bore_radius"},
                                  {"socket_depth", 0.45, 1, "bore_radius"},
                                  {"fillet", 0.08, 0.3, "bore_radius"},
                                  {"edge_rounding", 0.12, 0.4, "wall"}};
  all.insert(all.end(), ranges.begin(), ranges.end());
  return {name,
          summary,
          rows,
          {{"plain", "the default: without sockets", {}}, {"socket", "with sockets", with_sockets}},
          all};
}

Fitting read_fitting(const std::string& kind, const ParameterValues& v) {
  Fitting t;
  t.kind = kind;
  t.bore = parameter(v, "bore_radius");
  t.wall = parameter(v, "wall");
  t.has_socket = parameter(v, "socket") != 0;
  t.socket = parameter(v, "socket_radius");
  t.depth = parameter(v, "socket_depth");
  t.fillet = parameter(v, "fillet");
  t.edge = parameter(v, "edge_rounding");
  return t;
}

Solid make_fitting(const Fitting& t) {
  check(t);
  Solid solid;
  std::vector<Skins> skins;
  Skins whole;
  for (const Run& run : t.runs) {
    skins.push_back(make_run(t, run));
    whole.skin = whole.skin ? unite(std::move(whole.skin), skins.back().skin, t.fillet) : skins.back().skin;
    whole.bore = whole.bore ? unite(std::move(whole.bore), skins.back().bore, t.edge) : skins.back().bore;
    solid.part_names.push_back(run.part);
  }
  solid.surface = subtract(whole.skin, whole.bore, t.edge);
  solid.low = Vec3::Constant(-t.outer());
  solid.high = Vec3::Constant(t.outer());
  for (const Pipe& pipe : all_pipes(t)) {
    const Vec3 end = pipe.length * pipe.direction;
    const Vec3 aside = t.hub() * (Vec3::Ones() - pipe.direction.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    solid.low = solid.low.cwiseMin(end - aside);
    solid.high = solid.high.cwiseMax(end + aside);
    solid.features.push_back(rim(t, pipe));
  }
  // In the classes of the model no two rims lie farther apart than the box is long, opposite ones aside.
  const double longest = (solid.high - solid.low).maxCoeff();
  for (const Pipe& a : all_pipes(t))
    for (const Pipe& b : all_pipes(t))
      if (a.direction.dot(b.direction) > -0.99 &&
          (a.length * a.direction - b.length * b.direction).norm() > 0.96 * longest)
        solid.typical = false;
  for (std::size_t i = solid.features.size(); i < 4; ++i)
    solid.features.push_back({"rim" + std::to_string(i + 1), "circle", {}, {}, {}, {}});
  solid.thinnest = t.wall;
  solid.thinnest_parameter = "wall";
  solid.gap = narrowest_gap(t);
  if (t.has_socket && !t.bend)
    require(solid.gap >= 2.2 * t.fillet, t.kind, "fillet", t.fillet,
            fmt::format("the sockets must stand 2.2 fillets from each other, now {}", solid.gap),
            "give a smaller one, or longer pipes");
  solid.part_of = nearest_run(t, skins);
  return solid;
}

}  // namespace toposcope
