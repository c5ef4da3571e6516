// SPDX-License-Identifier: BSD-3-Clause
// The airplane's table of parameters and what they must keep to.

#include <algorithm>
#include <cmath>

#include "sample/airplane.h"

namespace toposcope {

namespace {

constexpr const char* airplane_name = "airplane";

void check_surface(const Airplane& a, const Planform& p, const std::string& name, const char* span) {
  const double chord = std::max(p.root_chord, p.tip_chord);
  require(p.tip_chord <= 1.2 * p.root_chord, airplane_name, name + "_tip_chord", p.tip_chord,
          "it may exceed the root's chord by a fifth at most", "give a smaller one");
  require(std::abs(p.sweep) <= 65 * pi / 180, airplane_name, name + "_sweep", p.sweep * 180 / pi,
          "it must lie between -65 and 65 degrees", "choose it in that range");
  require(p.span >= 0.6 * chord, airplane_name, name + span, p.span, "it must exceed 0.6 chords", "give a longer one");
  const double thinnest = p.trailing * p.thickness * p.tip_chord;
  require(thinnest >= 0.002 * a.length, airplane_name, name + "_tip_chord", p.tip_chord,
          "the trailing edge at the tip, trailing_edge * thickness * chord, must be at least 0.2 % of length thick",
          "give a larger one");
}

std::vector<SamplePreset> airplane_presets() {
  return {{"piper", "the default: one engine in the nose, low wings that taper little", {}},
          {"cessna",
           "high straight wings with an engine in each",
           {{"fuselage_radius", 5.6},
            {"nose_length", 16},
            {"tail_length", 48},
            {"wing_position", 30},
            {"wing_height", 3.8},
            {"wing_span", 112},
            {"wing_root_chord", 18},
            {"wing_tip_chord", 15},
            {"wing_sweep", 2},
            {"wing_dihedral", 2},
            {"engines", 2},
            {"engine_drop", 0.8},
            {"engine_length", 14},
            {"stabilizer_sweep", 6},
            {"stabilizer_tip_chord", 10},
            {"fin_sweep", 38},
            {"tip_rounding", 0.2}}},
          {"beechcraft",
           "a jet: swept low wings, a T-tail, engines beside the fuselage",
           {{"fuselage_radius", 5.4}, {"nose_length", 20},     {"tail_length", 38},     {"wing_position", 34},
            {"wing_span", 96},        {"wing_root_chord", 20}, {"wing_tip_chord", 9},   {"wing_sweep", 26},
            {"wing_dihedral", 5},     {"t_tail", 1},           {"fin_height", 23},      {"fin_position", 79},
            {"fin_sweep", 42},        {"fin_tip_chord", 11},   {"stabilizer_span", 36}, {"stabilizer_root_chord", 12},
            {"stabilizer_sweep", 26}, {"engines", 2},          {"engines_at_rear", 1},  {"engine_drop", 6.2},
            {"engine_length", 11},    {"tip_rounding", 0.6}}}};
}

std::vector<RandomRange> airplane_ranges() {
  return {{"length", 80, 125},
          {"fuselage_radius", 0.045, 0.075, "length"},
          {"nose_length", 1, 3.2, "fuselage_radius"},
          {"tail_length", 0.3, 0.5, "length"},
          {"tail_radius", 0.2, 0.5, "fuselage_radius"},
          {"wing_position", 0.25, 0.42, "length"},
          {"wing_height", -0.7, 0.7, "fuselage_radius"},
          {"wing_span", 0.8, 1.2, "length"},
          {"wing_root_chord", 0.15, 0.24, "length"},
          {"wing_tip_chord", 0.45, 0.95, "wing_root_chord"},
          {"wing_sweep", 0, 36},
          {"wing_dihedral", -2, 7},
          {"wing_thickness", 0.12, 0.18},
          {"t_tail", 0, 0.3},
          {"stabilizer_position", 0.78, 0.86, "length"},
          {"stabilizer_height", 0, 0.6, "tail_radius"},
          {"stabilizer_span", 0.3, 0.45, "length"},
          {"stabilizer_root_chord", 0.11, 0.14, "length"},
          {"stabilizer_tip_chord", 0.55, 0.9, "stabilizer_root_chord"},
          {"stabilizer_sweep", 4, 34},
          {"stabilizer_dihedral", -4, 6},
          {"fin_position", 0.77, 0.84, "length"},
          {"fin_height", 0.17, 0.26, "length"},
          {"fin_root_chord", 0.12, 0.16, "length"},
          {"fin_tip_chord", 0.5, 0.85, "fin_root_chord"},
          {"fin_sweep", 12, 44},
          {"tail_thickness", 0.13, 0.18},
          {"trailing_edge", 0.4, 0.8},
          {"tip_rounding", 0.1, 0.9},
          {"engines", 0, 4, "", 2},
          {"engines_at_rear", 0, 0.25},
          {"engine_radius", 0.018, 0.028, "length"},
          {"engine_length", 4, 6, "engine_radius"},
          {"engine_station", 0.28, 0.42},
          {"engine_drop", 0, 5, "engine_radius"},
          {"fillet", 0.2, 0.45, "fuselage_radius"}};
}

}  // namespace

SampleKind airplane_kind() {
  const auto ratio = [](const char* name, const char* value, const char* low, const char* high, const char* meaning) {
    return OptionRow{name, OptionType::real, "1", value, low, high, meaning};
  };
  return {
      "airplane",
      "an airplane whose nose, at the origin, looks along +x; up is +z, port +y",
      {length_parameter("length", "100", "0", "length of the fuselage"),
       length_parameter("fuselage_radius", "6", "0", "radius of the fuselage"),
       length_parameter("nose_length", "14", "0", "length of the rounded nose"),
       length_parameter("tail_length", "42", "0", "length over which the fuselage tapers"),
       length_parameter("tail_radius", "1.8", "0", "radius at the tail's end, which is round"),
       length_parameter("wing_position", "34", "0", "from the nose back to the wing's leading edge in the middle"),
       length_parameter("wing_height", "-3", "", "of the wing's root above the fuselage's axis; negative: a low wing"),
       length_parameter("wing_span", "100", "0", "from tip to tip, along the wings"),
       length_parameter("wing_root_chord", "21", "0", "in the middle of the fuselage"),
       length_parameter("wing_tip_chord", "12", "0", "at the tip, before it is rounded"),
       angle_parameter("wing_sweep", "12", "by which the leading edge leans back"),
       angle_parameter("wing_dihedral", "4", "by which the wings rise"),
       ratio("wing_thickness", "0.15", "0.05", "0.3", "of the section, in chords"),
       switch_parameter("t_tail", "false", "whether the stabiliser sits on top of the fin"),
       length_parameter("stabilizer_position", "84", "0", "from the nose back to its leading edge; not of a T-tail"),
       length_parameter("stabilizer_height", "0", "", "of its root above the fuselage's axis; not of a T-tail"),
       length_parameter("stabilizer_span", "38", "0", "from tip to tip"),
       length_parameter("stabilizer_root_chord", "13", "0", "in the middle"),
       length_parameter("stabilizer_tip_chord", "8", "0", "at the tip, before it is rounded"),
       angle_parameter("stabilizer_sweep", "18", "by which the leading edge leans back"),
       angle_parameter("stabilizer_dihedral", "0", "by which it rises to its tips"),
       length_parameter("fin_position", "82", "0", "from the nose back to its leading edge at the fuselage's axis"),
       length_parameter("fin_height", "20", "0", "from the fuselage's axis to its tip"),
       length_parameter("fin_root_chord", "16", "0", "at the fuselage's axis"),
       length_parameter("fin_tip_chord", "8", "0", "at the tip, before it is rounded"),
       angle_parameter("fin_sweep", "30", "by which the leading edge leans back"),
       ratio("tail_thickness", "0.16", "0.05", "0.3", "of the sections of stabiliser and fin, in chords"),
       ratio("trailing_edge", "0.5", "0.2", "1", "thickness of trailing edges, in parts of the section's thickness"),
       ratio("tip_rounding", "0.4", "0", "1", "how much of each tip is round in plan"),
       OptionRow{"engines", OptionType::integer, "", "0", "0", "4", "how many: 0, 2 or 4"},
       switch_parameter("engines_at_rear", "false", "two engines beside the fuselage instead of under the wings"),
       length_parameter("engine_radius", "2.6", "0", "radius of a nacelle"),
       length_parameter("engine_length", "13", "0", "length of a nacelle"),
       ratio("engine_station", "0.34", "0.1", "0.9", "place of the inner engines, in parts of the half span"),
       length_parameter(
           "engine_drop", "7.5", "0",
           "of the engine's axis below the wing, or beyond the fuselage's side; over engine_radius with a pylon"),
       length_parameter("fillet", "2", "0", "radius of the fillets where wings and stabilisers meet the fuselage")},
      airplane_presets(),
      airplane_ranges()};
}

void check_airplane(const Airplane& a) {
  require(a.radius <= 0.2 * a.length && a.radius >= 0.02 * a.length, airplane_name, "fuselage_radius", a.radius,
          "it must lie between 0.02 and 0.2 length", "choose it in that range");
  require(a.nose + a.tail <= 0.9 * a.length, airplane_name, "tail_length", a.tail,
          "nose and tail must leave a tenth of the fuselage straight", "give a shorter one");
  require(a.nose >= 0.6 * a.radius, airplane_name, "nose_length", a.nose, "it must be at least 0.6 fuselage_radius",
          "give a longer one");
  require(a.tail >= 2 * a.radius, airplane_name, "tail_length", a.tail, "it must be at least 2 fuselage_radius",
          "give a longer one");
  require(a.tail_radius <= 0.6 * a.radius && a.tail_radius >= 0.1 * a.radius, airplane_name, "tail_radius",
          a.tail_radius, "it must lie between 0.1 and 0.6 fuselage_radius", "choose it in that range");
  check_surface(a, a.wing, "wing", "_span");
  check_surface(a, a.stabilizer, "stabilizer", "_span");
  check_surface(a, a.fin, "fin", "_height");
  require(a.fillet >= 0.05 * a.radius && a.fillet <= 0.6 * a.radius, airplane_name, "fillet", a.fillet,
          "it must lie between 0.05 and 0.6 fuselage_radius", "choose it in that range");
  require(std::abs(a.wing_height) <= 0.8 * a.radius, airplane_name, "wing_height", a.wing_height,
          "the wing must meet the fuselage: at most 0.8 fuselage_radius from its axis", "bring it closer");
  require(a.wing.span >= 3 * a.radius, airplane_name, "wing_span", 2 * a.wing.span,
          "it must be at least 6 fuselage_radius", "give longer wings");
  require(std::abs(a.wing.v.z()) <= 0.35, airplane_name, "wing_dihedral", std::asin(a.wing.v.z()) * 180 / pi,
          "it must lie within 20 degrees", "give a smaller one");
  require(std::abs(a.stabilizer.v.z()) <= 0.5, airplane_name, "stabilizer_dihedral",
          std::asin(a.stabilizer.v.z()) * 180 / pi, "it must lie within 30 degrees", "give a smaller one");
  const double wing_end = a.wing_position + a.wing.root_chord;
  require(a.wing_position >= 0.6 * a.nose, airplane_name, "wing_position", a.wing_position,
          "the wing must begin behind the nose (0.6 nose_length)", "move it back");
  require(a.fin_position + a.fin.root_chord <= a.length, airplane_name, "fin_position", a.fin_position,
          "the fin's root must end before the fuselage does", "move it forward");
  require(a.fin_position >= wing_end + 2.2 * a.fillet, airplane_name, "fin_position", a.fin_position,
          "the fin must begin behind the wing, by 2.2 fillets", "move the wing forward or the fin back");
  require(a.fin.span >= a.radius + a.fillet + 0.5 * a.fin.tip_chord, airplane_name, "fin_height", a.fin.span,
          "it must stand out of the fuselage by half a tip chord", "give a higher one");
  const double half_thick = a.stabilizer.thickness * a.stabilizer.root_chord / 2;
  if (!a.t_tail) {
    require(a.stabilizer_position >= wing_end + 2.2 * a.fillet, airplane_name, "stabilizer_position",
            a.stabilizer_position, "the stabiliser must begin behind the wing, by 2.2 fillets",
            "move the wing forward or the stabiliser back");
    require(a.stabilizer_position + a.stabilizer.root_chord <= a.length, airplane_name, "stabilizer_position",
            a.stabilizer_position, "the stabiliser's root must end before the fuselage does", "move it forward");
    require(std::abs(a.stabilizer.origin.z()) <= 0.6 * a.fuselage_radius(a.stabilizer_position), airplane_name,
            "stabilizer_height", a.stabilizer.origin.z(), "the stabiliser must meet the fuselage",
            "bring it closer to 0");
  } else {
    require(a.stabilizer.origin.z() - half_thick >= a.radius + 2.2 * a.fillet, airplane_name, "fin_height", a.fin.span,
            "the fin must lift the T-tail's stabiliser clear of the fuselage", "give a higher fin");
  }
  require(a.stabilizer.span >= 1.5 * a.radius || a.t_tail, airplane_name, "stabilizer_span", 2 * a.stabilizer.span,
          "it must be at least 3 fuselage_radius", "give a longer one");
  if (a.engines == 0) return;
  require(a.engines == 2 || a.engines == 4, airplane_name, "engines", a.engines, "it must be 0, 2 or 4",
          "choose one of them");
  require(a.engine_length >= 3 * a.engine_radius, airplane_name, "engine_length", a.engine_length,
          "it must be at least 3 engine_radius", "give a longer one");
  require(a.engine_radius >= 0.012 * a.length && a.engine_radius <= 0.8 * a.radius, airplane_name, "engine_radius",
          a.engine_radius, "it must lie between 0.012 length and 0.8 fuselage_radius", "choose it in that range");
  if (a.rear_engines) {
    require(a.engines == 2, airplane_name, "engines", a.engines, "at the rear there may be two", "give engines=2");
    require(a.engine_drop >= 2.2 * a.engine_radius && a.engine_drop <= 4 * a.engine_radius, airplane_name,
            "engine_drop", a.engine_drop, "at the rear it must lie between 2.2 and 4 engine_radius",
            "choose it in that range");
    require(engine_gap(a) >= 0.7 * a.engine_radius, airplane_name, "engine_length", a.engine_length,
            "engines at the rear must clear wing and tail by 0.7 engine_radius",
            "give shorter ones, a lower or less swept wing, or more room between wing and tail");
    return;
  }
  const int engines_a_side = a.engines / 2;
  const double station = a.engine_station * a.wing.span, outermost = station * engines_a_side;
  require(station >= a.radius + a.engine_radius + a.fillet, airplane_name, "engine_station", a.engine_station,
          "the engines must clear the fuselage", "move them outwards");
  require(outermost <= 0.85 * a.wing.span, airplane_name, "engine_station", a.engine_station,
          "the outermost engines must lie within 0.85 of the half span", "move them inwards");
  require(a.engines == 2 || station >= 2.5 * a.engine_radius, airplane_name, "engine_station", a.engine_station,
          "two engines under a wing must clear each other", "move them outwards");
  const double half_wing = a.wing.thickness * a.wing.chord(station) / 2;
  const bool on_wing = a.engine_drop <= 0.8 * a.engine_radius;
  const bool on_pylon = a.engine_drop >= 2.2 * a.engine_radius + half_wing && a.engine_drop <= 6 * a.engine_radius;
  require(on_wing || on_pylon, airplane_name, "engine_drop", a.engine_drop,
          "the engine must sit in the wing (at most 0.8 engine_radius) or hang clear of it (from 2.2 engine_radius "
          "and half the wing's thickness, here " +
              std::to_string(2.2 * a.engine_radius + half_wing) + ", to 6 engine_radius)",
          "choose it so");
  require(a.engine_length <= 1.2 * a.wing.chord(outermost) + 0.2 * a.wing.root_chord, airplane_name, "engine_length",
          a.engine_length, "the engines must be about as long as the wing's chord at most", "give shorter ones");
}

}  // namespace toposcope
