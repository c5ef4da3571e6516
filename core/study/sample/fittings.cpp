// SPDX-License-Identifier: BSD-3-Clause
// The five fittings of models/pipe-fitting.yaml. Runs lie along x.

#include <cmath>

#include "sample/fitting.h"

namespace toposcope {

namespace {

const Vec3 left = -Vec3::UnitX(), right = Vec3::UnitX(), front = -Vec3::UnitY(), up = Vec3::UnitZ();

/// Two pipes in one line, whose whole length is a parameter.
Run straight_run(const std::string& part, const std::string& rim, const std::string& opposite, const Vec3& direction,
                 double length, const std::string& length_parameter) {
  return {
      part,
      {{rim, direction, length / 2, length_parameter, 0.5}, {opposite, -direction, length / 2, length_parameter, 0.5}}};
}

}  // namespace

SampleKind tee_kind() {
  return fitting_kind(
      "tee", "a pipe tee: a run along x and a branch along +z from its middle",
      {length_parameter("run_length", "120", "0", "length of the run, end to end"),
       length_parameter("branch_length", "60", "0", "distance from the run's axis to the branch's end")},
      {{"run_length", 140}, {"branch_length", 70}},
      {{"run_length", 4.2, 9, "bore_radius"}, {"branch_length", 2.1, 4.8, "bore_radius"}});
}

Solid make_tee(const ParameterValues& parameters) {
  Fitting t = read_fitting("tee", parameters);
  t.runs = {straight_run("run", "rim1", "rim2", right, parameter(parameters, "run_length"), "run_length"),
            {"branch", {{"rim3", up, parameter(parameters, "branch_length"), "branch_length"}}}};
  return make_fitting(t);
}

SampleKind cross_kind() {
  return fitting_kind("cross", "a pipe cross: a run along x and a run along z through its middle",
                      {length_parameter("run_length", "120", "0", "length of the run along x, end to end"),
                       length_parameter("cross_length", "120", "0", "length of the run along z, end to end")},
                      {{"run_length", 140}, {"cross_length", 140}},
                      {{"run_length", 4.2, 9, "bore_radius"}, {"cross_length", 4.2, 9, "bore_radius"}});
}

Solid make_cross(const ParameterValues& parameters) {
  Fitting t = read_fitting("cross", parameters);
  t.runs = {straight_run("run", "rim1", "rim2", right, parameter(parameters, "run_length"), "run_length"),
            straight_run("branch", "rim3", "rim4", up, parameter(parameters, "cross_length"), "cross_length")};
  return make_fitting(t);
}

SampleKind wye_kind() {
  return fitting_kind(
      "wye", "a pipe wye: a run along x and a branch that leans towards +x from +z",
      {length_parameter("run_length", "150", "0", "length of the run, end to end"),
       length_parameter("back_length", "60", "0", "distance from where the axes meet back to the run's end"),
       length_parameter("branch_length", "90", "0", "distance from where the axes meet to the branch's end"),
       angle_parameter("branch_angle", "45", "between the branch and the run's +x half")},
      {{"run_length", 190}, {"back_length", 80}, {"branch_length", 110}},
      {{"run_length", 7, 12, "bore_radius"},
       {"back_length", 0.38, 0.5, "run_length"},
       {"branch_length", 0.46, 0.62, "run_length"},
       {"branch_angle", 40, 52}});
}

Solid make_wye(const ParameterValues& parameters) {
  Fitting t = read_fitting("wye", parameters);
  const double angle = parameter(parameters, "branch_angle");
  require(angle >= 30 && angle <= 75, "wye", "branch_angle", angle, "it must lie between 30 and 75 degrees",
          "choose it in that range; at 90 degrees it is a tee");
  const double run = parameter(parameters, "run_length"), back = parameter(parameters, "back_length");
  const double turn = angle * pi / 180;
  t.runs = {
      {"run", {{"rim1", right, run - back, "run_length"}, {"rim2", left, back, "back_length"}}},
      {"branch",
       {{"rim3", Vec3(std::cos(turn), 0, std::sin(turn)), parameter(parameters, "branch_length"), "branch_length"}}}};
  Solid solid = make_fitting(t);
  // The class's third rim lies near the first.
  const Pipe &first = t.runs[0].pipes[0], &third = t.runs[1].pipes[0];
  if ((first.length * first.direction - third.length * third.direction).norm() >
      0.48 * (solid.high - solid.low).maxCoeff())
    solid.typical = false;
  return solid;
}

SampleKind elbow_kind() {
  return fitting_kind("elbow", "a pipe elbow of 90 degrees: a leg along +x and a leg along +z",
                      {length_parameter("leg1_length", "42", "0", "distance from where the axes meet to the end at +x"),
                       length_parameter("leg2_length", "42", "0", "distance from where the axes meet to the end at +z"),
                       switch_parameter("mitred", "false", "true: the legs meet in a corner instead of a bend"),
                       length_parameter("bend_radius", "30", "0", "radius of the bend's centre line")},
                      {{"leg1_length", 47}, {"leg2_length", 47}, {"socket_depth", 14}, {"bend_radius", 24.5}},
                      {{"mitred", 0, 0.4},
                       {"bend_radius", 1.45, 2.1, "bore_radius"},
                       {"leg1_length", 2, 3.6, "bore_radius"},
                       {"leg2_length", 2, 3.6, "bore_radius"}});
}

Solid make_elbow(const ParameterValues& parameters) {
  Fitting t = read_fitting("elbow", parameters);
  const Pipe one{"rim1", right, parameter(parameters, "leg1_length"), "leg1_length"};
  const Pipe two{"rim2", up, parameter(parameters, "leg2_length"), "leg2_length"};
  if (parameter(parameters, "mitred") != 0) {
    t.runs = {{"leg1", {one}}, {"leg2", {two}}};
  } else {
    t.runs = {{"leg1", {one, two}}};
    t.bend = parameter(parameters, "bend_radius");
  }
  Solid solid = make_fitting(t);
  solid.part_names = {"leg1", "leg2"};
  solid.part_of = [](const Vec3& p) -> std::size_t { return p.z() > p.x() ? 1 : 0; };
  return solid;
}

SampleKind tricorner_kind() {
  return fitting_kind(
      "tricorner", "a pipe corner: three legs along +x, +z and -y, each at right angles to the others",
      {length_parameter("leg1_length", "42", "0", "distance from where the axes meet to the end at +x"),
       length_parameter("leg2_length", "42", "0", "distance from where the axes meet to the end at +z"),
       length_parameter("leg3_length", "42", "0", "distance from where the axes meet to the end at -y")},
      {{"leg1_length", 47}, {"leg2_length", 47}, {"leg3_length", 47}, {"socket_depth", 14}, {"fillet", 3}},
      {{"leg1_length", 2, 3.4, "bore_radius"},
       {"leg2_length", 2, 3.4, "bore_radius"},
       {"leg3_length", 2, 3.4, "bore_radius"}});
}

Solid make_tricorner(const ParameterValues& parameters) {
  Fitting t = read_fitting("tricorner", parameters);
  t.runs = {{"leg1", {{"rim1", right, parameter(parameters, "leg1_length"), "leg1_length"}}},
            {"leg2", {{"rim2", up, parameter(parameters, "leg2_length"), "leg2_length"}}},
            {"leg3", {{"rim3", front, parameter(parameters, "leg3_length"), "leg3_length"}}}};
  return make_fitting(t);
}

}  // namespace toposcope
