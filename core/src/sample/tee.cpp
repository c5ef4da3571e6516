// SPDX-License-Identifier: BSD-3-Clause
// A pipe tee: a run along x and a branch along +z from its middle, of one bore.

#include <algorithm>
#include <cmath>

#include "sample/solid.h"

namespace toposcope {

namespace {

constexpr const char* kind = "tee";

struct Tee {
  explicit Tee(const ParameterValues& v)
      : bore(parameter(v, "bore_radius")),
        wall(parameter(v, "wall")),
        run(parameter(v, "run_length")),
        branch(parameter(v, "branch_length")),
        has_socket(parameter(v, "socket") != 0),
        socket(parameter(v, "socket_radius")),
        depth(parameter(v, "socket_depth")),
        fillet(parameter(v, "fillet")),
        edge(parameter(v, "edge_rounding")) {}

  double bore, wall, run, branch;
  bool has_socket;
  double socket, depth, fillet, edge;

  double outer() const { return bore + wall; }
  double mouth() const { return has_socket ? socket : bore; }  ///< inner radius of an opening
  double hub() const { return mouth() + wall; }                ///< outer radius at an opening
  double hub_length() const { return has_socket ? depth + wall : 0; }
};

void check(const Tee& t) {
  require(t.wall >= 0.02 * std::max(t.run, t.branch) && t.wall >= 0.05 * t.bore, kind, "wall", t.wall,
          "the wall must be at least 2 % of the tee's length and 5 % of its bore radius", "give a thicker wall");
  require(t.wall <= 2 * t.bore, kind, "wall", t.wall, "the wall may be at most twice bore_radius",
          "give a thinner wall or a wider bore");
  require(t.edge >= 0.1 * t.wall && t.edge <= 0.45 * t.wall, kind, "edge_rounding", t.edge,
          "it must lie between 0.1 and 0.45 wall", "choose it in that range");
  require(t.fillet >= 0.1 * t.wall && t.fillet <= 0.8 * t.outer(), kind, "fillet", t.fillet,
          "it must lie between wall / 10 and 0.8 (bore_radius + wall)", "choose it in that range");
  if (t.has_socket) {
    require(t.socket >= t.bore + 0.2 * t.wall && t.socket <= 2 * t.bore, kind, "socket_radius", t.socket,
            "it must lie between bore_radius + wall / 5 and 2 bore_radius", "choose it in that range");
    require(t.depth >= t.wall, kind, "socket_depth", t.depth, "it must be at least wall", "give a deeper socket");
  }
  const double clear = t.outer() + t.fillet + t.hub_length() + (t.has_socket ? t.hub() - t.outer() : 2 * t.edge);
  const char* remedy = "make it longer, or the fillet or socket smaller";
  require(t.run / 2 >= clear, kind, "run_length", t.run,
          "half of it must leave room for the branch, its fillet and the socket (" + std::to_string(clear) + ")",
          remedy);
  require(t.branch >= clear, kind, "branch_length", t.branch,
          "it must leave room for the run, the fillet and the socket (" + std::to_string(clear) + ")", remedy);
}

/// Outer skin of one arm, from beyond the middle out to its end at `length`. The arm's inner end is a half ball that
/// lies within the other arm and touches it smoothly: a flat end would make a false corner there.
Implicit arm_skin(const Tee& t, double length, const Vec3& axis) {
  std::vector<Corner> corners = {{0, -t.outer()}, {t.outer(), -t.outer(), t.outer()}};
  if (t.has_socket) {
    const double step = length - t.hub_length();
    const double rounding = std::min(t.wall, 0.4 * (t.hub() - t.outer()));
    corners.push_back({t.outer(), step - (t.hub() - t.outer()), rounding});  // a cone of 45 degrees
    corners.push_back({t.hub(), step, rounding});
  }
  corners.push_back({t.hub(), length, t.edge});
  corners.push_back({0, length});
  return revolve(PlanePath(corners), Vec3::Zero(), axis);
}

/// Bore of one arm, open beyond its end.
Implicit arm_bore(const Tee& t, double length, const Vec3& axis) {
  const double beyond = length + t.hub();
  std::vector<Corner> corners = {{0, -t.bore}, {t.bore, -t.bore, t.bore}};
  if (t.has_socket) {
    const double rounding = std::min(t.edge, 0.4 * (t.socket - t.bore));
    corners.push_back({t.bore, length - t.depth, rounding});
    corners.push_back({t.socket, length - t.depth, rounding});
  }
  corners.push_back({t.mouth(), beyond});
  corners.push_back({0, beyond});
  return revolve(PlanePath(corners), Vec3::Zero(), axis);
}

SampleFeature rim(const Tee& t, const std::string& name, double length, const Vec3& axis) {
  const double inset = t.edge * (1 - std::sqrt(0.5));  // the rounded edge's 45-degree point
  SampleFeature feature = circle_feature(name, (length - inset) * axis, axis, t.hub() - inset);
  feature.parameters.push_back({"band", {t.mouth(), t.hub()}});
  return feature;
}

}  // namespace

SampleKind tee_kind() {
  return {"tee",
          "a pipe tee: a run along x and a branch along +z from its middle",
          {length_parameter("bore_radius", "16", "0", "inner radius of run and branch"),
           length_parameter("wall", "4", "0", "thickness of the wall"),
           length_parameter("run_length", "120", "0", "length of the run, end to end"),
           length_parameter("branch_length", "60", "0", "distance from the run's axis to the branch's end"),
           switch_parameter("socket", "false", "whether the openings are widened to sockets"),
           length_parameter("socket_radius", "19", "0", "inner radius of a socket"),
           length_parameter("socket_depth", "16", "0", "depth of a socket"),
           length_parameter("fillet", "6", "0", "radius of the fillet where the branch leaves the run"),
           length_parameter("edge_rounding", "1", "0", "radius that rounds the edges of the openings")}};
}

Solid make_tee(const ParameterValues& parameters) {
  const Tee t(parameters);
  check(t);
  const Vec3 left = -Vec3::UnitX(), right = Vec3::UnitX(), up = Vec3::UnitZ();
  const double half = t.run / 2;
  // The two halves of the run join without a trace: each ends in a half ball inside the other.
  const Implicit run_skin = unite(arm_skin(t, half, left), arm_skin(t, half, right));
  const Implicit run_bore = unite(arm_bore(t, half, left), arm_bore(t, half, right));
  const Implicit branch_skin = arm_skin(t, t.branch, up);
  const Implicit branch_bore = arm_bore(t, t.branch, up);

  Solid solid;
  solid.surface = subtract(unite(run_skin, branch_skin, t.fillet), unite(run_bore, branch_bore, t.edge), t.edge);
  const double radius = std::max(t.hub(), t.outer());
  solid.low = Vec3(-half, -radius, -radius);
  solid.high = Vec3(half, radius, t.branch);
  solid.thinnest = t.wall;
  solid.thinnest_parameter = "wall";
  solid.part_names = {"run", "branch"};
  solid.part_of = [=](const Vec3& p) -> std::size_t {
    const double run = std::min(std::abs(run_skin(p).value), std::abs(run_bore(p).value));
    const double branch = std::min(std::abs(branch_skin(p).value), std::abs(branch_bore(p).value));
    return p.z() > 0 && branch < run ? 1 : 0;
  };
  solid.features = {rim(t, "rim1", half, right), rim(t, "rim2", half, left), rim(t, "rim3", t.branch, up)};
  return solid;
}

}  // namespace toposcope
