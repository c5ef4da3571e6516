// SPDX-License-Identifier: BSD-3-Clause
// Drilled plates and flanges, laid out at random: their numbers are parameters, their places follow from `layout`.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>

#include "sample/drilled_plate.h"
#include "toposcope/system/random.h"

namespace toposcope {

namespace {

constexpr int most_holes = 60;

OptionRow count_parameter(const char* name, const char* default_value, const char* least, const char* most,
                          const char* meaning) {
  return {name, OptionType::integer, "", default_value, least, most, meaning};
}

OptionRow share_parameter(const char* name, const char* default_value, const char* meaning) {
  return {name, OptionType::real, "1", default_value, "0", "1", meaning};
}

/// What plates and flanges have in common.
std::vector<OptionRow> with_common(std::vector<OptionRow> rows) {
  rows.push_back(count_parameter("slots", "1", "0", "10", "long holes with round ends, which are no round holes"));
  rows.push_back(count_parameter("hexagons", "1", "0", "10", "six-sided holes, likewise"));
  rows.push_back(count_parameter("segments", "48", "12", "200", "corners of a full turn; not of a scan"));
  rows.push_back(switch_parameter("unwelded", "false", "every face has corners of its own, as in STL; not of a scan"));
  rows.push_back(count_parameter("layout", "1", "1", "1000000", "which of the random places and choices"));
  return rows;
}

std::vector<RandomRange> with_common(std::vector<RandomRange> ranges) {
  for (const RandomRange& each : {RandomRange{"slots", 0, 3, "", 1}, RandomRange{"hexagons", 0, 3, "", 1},
                                  RandomRange{"segments", 12, 200, "", 1}, RandomRange{"unwelded", 0, 0.4},
                                  RandomRange{"layout", 1, 1000000, "", 1}})
    ranges.push_back(each);
  return ranges;
}

/// What is smaller does not come through a file of single precision.
void check_radii(const DrilledPlate& plate, const ParameterValues& values, std::initializer_list<const char*> names) {
  for (const char* name : names)
    require(parameter(values, name) >= 1e-4 * plate.length, plate.kind, name, parameter(values, name),
            "it must be at least 1e-4 of the plate's length", "give a larger one");
}

/// Finds places on a plate.
class Layout {
 public:
  Layout(DrilledPlate& plate, const ParameterValues& values)
      : plate_(plate), values_(values), random_(splitmix64(static_cast<std::uint64_t>(number("layout")))) {}

  double number(std::string_view name) const { return parameter(values_, name); }
  int count(std::string_view name) const { return static_cast<int>(number(name)); }
  double uniform(double low, double high) { return low + (high - low) * uniform_closed_open(random_()); }
  bool chance(double share) { return uniform(0, 1) < share; }

  /// Whether a disc keeps its distance from the edge and from all that is there.
  bool is_free(const Vec2& center, double reach) const {
    const double room = reach + plate_.margin;
    return plate_.inset(center) >= room &&
           std::none_of(plate_.cuts.begin(), plate_.cuts.end(),
                        [&](const PlateCut& c) { return (c.center - center).norm() < room + c.reach(); }) &&
           std::none_of(plate_.bosses.begin(), plate_.bosses.end(),
                        [&](const PlateBoss& b) { return (b.center - center).norm() < room + b.radius; });
  }

  /// \throw UsageError  none of many tries is free
  Vec2 free_place(double reach, const char* parameter_name) {
    constexpr int most_tries = 2000;
    for (int i = 0; i < most_tries; ++i) {
      Vec2 place(uniform(-0.5, 0.5) * plate_.length, uniform(-0.5, 0.5) * plate_.width);
      if (is_free(place, reach)) return place;
    }
    require(false, plate_.kind, parameter_name, number(parameter_name),
            fmt::format("there is no room for all of them, {} from each other and from the edge", plate_.margin),
            "give fewer or smaller ones, or another layout");
    return Vec2::Zero();
  }

  void add_bolt_circle(const Vec2& center, int holes, double pitch_radius, const PlateCut& pattern) {
    const double first = uniform(0, 2 * pi);
    for (int i = 0; i < holes; ++i) {
      const double angle = first + 2 * pi * i / holes;
      PlateCut& hole = plate_.cuts.emplace_back(pattern);
      hole.center = center + pitch_radius * Vec2(std::cos(angle), std::sin(angle));
      hole.turn = uniform(0, 2 * pi);
      hole.bolt_circle = pitch_radius;
    }
  }

  /// Blind or countersunk by chance, as deep as the plate allows.
  PlateCut drilled(double radius, double blind, double countersunk) {
    PlateCut hole;
    hole.radius = radius;
    hole.turn = uniform(0, 2 * pi);
    const double depth = uniform(0.4, 0.75) * plate_.thickness, widening = uniform(1.5, 1.9);
    if (chance(blind))
      hole.depth = depth;
    else if (chance(countersunk))
      hole.countersink = radius + std::min((widening - 1) * radius, 0.5 * plate_.thickness);
    return hole;
  }

  void add_decoys(double size) {
    for (int i = 0; i < count("slots"); ++i) {
      PlateCut slot;
      slot.kind = PlateCut::Kind::slot;
      slot.radius = size * uniform(0.7, 1.2);
      slot.length = slot.radius * uniform(1.2, 4);
      slot.turn = uniform(0, 2 * pi);
      slot.center = free_place(slot.reach(), "slots");
      plate_.cuts.push_back(slot);
    }
    for (int i = 0; i < count("hexagons"); ++i) {
      PlateCut hexagon;
      hexagon.kind = PlateCut::Kind::hexagon;
      hexagon.radius = size * uniform(0.8, 1.4);
      hexagon.turn = uniform(0, 2 * pi);
      hexagon.center = free_place(hexagon.reach(), "hexagons");
      plate_.cuts.push_back(hexagon);
    }
  }

 private:
  DrilledPlate& plate_;
  const ParameterValues& values_;
  std::mt19937_64 random_;
};

Solid finished(const DrilledPlate& plate, const ParameterValues& values) {
  return solid_of(plate, static_cast<int>(parameter(values, "segments")), parameter(values, "unwelded") != 0);
}

/// Holes of a circle must not meet.
void check_bolt_circle(const std::string& kind, int holes, double pitch_radius, const PlateCut& hole, double margin,
                       const char* name) {
  require(2 * pitch_radius * std::sin(pi / std::max(holes, 2)) >= 2 * hole.reach() + margin, kind, name, pitch_radius,
          fmt::format("{} holes of radius {} must be {} from each other", holes, hole.reach(), margin),
          "give a larger one, or fewer or smaller holes");
}

}  // namespace

SampleKind plate_kind() {
  return {"plate",
          "a drilled plate: holes in any number, blind or through or countersunk, a bolt circle, bosses; z is up",
          with_common(std::vector<OptionRow>{
              length_parameter("length", "160", "0", "along x"),
              length_parameter("width", "100", "0", "along y"),
              length_parameter("thickness", "10", "0", "along z"),
              length_parameter("corner_radius", "8", "0", "of the four corners"),
              count_parameter("holes", "8", "0", "60", "round holes beside those of the bolt circle"),
              length_parameter("hole_radius", "4", "0", "mean radius of these"),
              {"hole_spread", OptionType::real, "1", "0.25", "0", "0.6",
               "of their radii about the mean, in three sizes, as part of it"},
              share_parameter("blind", "0.25", "part of these that does not go through"),
              share_parameter("countersunk", "0.3", "part of the others that has a countersink"),
              count_parameter("bolt_holes", "6", "0", "24", "holes of a bolt circle: none, or three and more"),
              length_parameter("bolt_circle_radius", "24", "0", "radius of the circle of their middles"),
              length_parameter("bolt_hole_radius", "3", "0", "radius of each"),
              count_parameter("bosses", "1", "0", "6", "round bosses on the plate"),
              length_parameter("boss_radius", "9", "0", "radius of each"),
              length_parameter("boss_height", "6", "0", "above the plate")}),
          {{"plain", "the default: holes of all kinds and a bolt circle", {}},
           {"bare",
            "through holes and nothing else",
            {{"blind", 0}, {"countersunk", 0}, {"bolt_holes", 0}, {"bosses", 0}, {"slots", 0}, {"hexagons", 0}}}},
          with_common(std::vector<RandomRange>{{"length", 120, 240},
                                               {"width", 0.5, 1, "length"},
                                               {"thickness", 0.04, 0.1, "length"},
                                               {"corner_radius", 0.02, 0.2, "width"},
                                               {"holes", 3, 48, "", 1},
                                               {"hole_radius", 0.014, 0.035, "length"},
                                               {"hole_spread", 0, 0.4},
                                               {"blind", 0, 0.5},
                                               {"countersunk", 0, 0.5},
                                               {"bolt_holes", 0, 12, "", 3},
                                               {"bolt_circle_radius", 0.12, 0.24, "width"},
                                               {"bolt_hole_radius", 0.012, 0.022, "length"},
                                               {"bosses", 0, 2, "", 1},
                                               {"boss_radius", 0.03, 0.06, "length"},
                                               {"boss_height", 0.3, 0.9, "thickness"}})};
}

Solid make_plate(const ParameterValues& values) {
  DrilledPlate plate;
  plate.kind = "plate";
  plate.length = parameter(values, "length");
  plate.width = parameter(values, "width");
  plate.thickness = parameter(values, "thickness");
  plate.corner_radius = parameter(values, "corner_radius");
  plate.margin = 0.3 * plate.thickness;
  require(plate.corner_radius <= 0.45 * std::min(plate.length, plate.width), plate.kind, "corner_radius",
          plate.corner_radius, "it may be at most 0.45 of length and width", "give a smaller one");
  require(plate.width >= 0.01 * plate.length && plate.width <= 100 * plate.length, plate.kind, "width", plate.width,
          "it must lie between 0.01 and 100 times the length", "choose it in that range");
  check_radii(plate, values, {"corner_radius", "hole_radius", "bolt_hole_radius", "boss_radius"});
  require(plate.thickness <= 0.3 * std::min(plate.length, plate.width), plate.kind, "thickness", plate.thickness,
          "a plate is at most 0.3 of its length and width thick", "give a thinner one");
  Layout layout(plate, values);
  const int bolts = layout.count("bolt_holes"), free_holes = layout.count("holes");
  require(bolts == 0 || bolts >= 3, plate.kind, "bolt_holes", bolts, "a circle takes three", "give 0, or 3 and more");
  require(bolts + free_holes >= 1 && bolts + free_holes <= most_holes, plate.kind, "holes", free_holes,
          "with those of the bolt circle there must be 1 to 60", "give another number");
  if (bolts > 0) {
    const double pitch = layout.number("bolt_circle_radius");
    const PlateCut bolt = layout.drilled(layout.number("bolt_hole_radius"), 0, layout.number("countersunk"));
    check_bolt_circle(plate.kind, bolts, pitch, bolt, plate.margin, "bolt_circle_radius");
    layout.add_bolt_circle(layout.free_place(pitch + bolt.reach(), "bolt_circle_radius"), bolts, pitch, bolt);
  }
  for (int i = 0; i < layout.count("bosses"); ++i) {
    PlateBoss boss{Vec2::Zero(), layout.number("boss_radius"), layout.number("boss_height"), layout.uniform(0, 2 * pi)};
    boss.center = layout.free_place(boss.radius, "bosses");
    plate.bosses.push_back(boss);
  }
  layout.add_decoys(layout.number("hole_radius"));
  const double mean = layout.number("hole_radius"), spread = layout.number("hole_spread");
  for (int i = 0; i < free_holes; ++i) {
    const double size = mean * (1 + spread * std::floor(layout.uniform(-1, 2)));
    PlateCut hole = layout.drilled(size, layout.number("blind"), layout.number("countersunk"));
    hole.center = layout.free_place(hole.reach(), "holes");
    plate.cuts.push_back(hole);
  }
  return finished(plate, values);
}

SampleKind flange_kind() {
  return {
      "flange",
      "a pipe flange: a disc with a bore, perhaps a hub around it, and a circle of bolt holes; z is up",
      with_common(std::vector<OptionRow>{
          length_parameter("radius", "90", "0", "of the disc"), length_parameter("thickness", "14", "0", "of the disc"),
          length_parameter("bore_radius", "36", "0", "of the bore through disc and hub"),
          switch_parameter("hub", "true", "whether a neck stands around the bore"),
          length_parameter("hub_radius", "48", "0", "outer radius of the neck"),
          length_parameter("hub_height", "20", "0", "of the neck above the disc"),
          count_parameter("holes", "8", "3", "60", "bolt holes, equally spaced"),
          length_parameter("hole_radius", "6", "0", "radius of each"),
          length_parameter("bolt_circle_radius", "72", "0", "radius of the circle of their middles"),
          switch_parameter("countersunk", "false", "whether they have countersinks")}),
      {{"neck", "the default: with a neck", {}},
       {"blind", "a flat disc with a small bore", {{"hub", 0}, {"bore_radius", 10}, {"slots", 0}, {"hexagons", 0}}}},
      with_common(std::vector<RandomRange>{{"radius", 50, 200},
                                           {"thickness", 0.1, 0.2, "radius"},
                                           {"bore_radius", 0.2, 0.42, "radius"},
                                           {"hub", 0, 0.5},
                                           {"hub_radius", 1.15, 1.4, "bore_radius"},
                                           {"hub_height", 0.8, 2, "thickness"},
                                           {"holes", 3, 36, "", 1},
                                           {"hole_radius", 0.03, 0.075, "radius"},
                                           {"bolt_circle_radius", 0.7, 0.85, "radius"},
                                           {"countersunk", 0, 0.3}})};
}

Solid make_flange(const ParameterValues& values) {
  DrilledPlate plate;
  plate.kind = "flange";
  plate.corner_radius = parameter(values, "radius");
  plate.length = plate.width = 2 * plate.corner_radius;
  check_radii(plate, values, {"hole_radius", "bore_radius"});
  plate.thickness = parameter(values, "thickness");
  plate.margin = 0.2 * plate.thickness;
  Layout layout(plate, values);
  PlateCut bore;
  bore.name = "bore";
  bore.radius = layout.number("bore_radius");
  double middle = bore.radius;  // what is taken around the axis
  if (layout.number("hub") != 0) {
    middle = layout.number("hub_radius");
    require(middle >= bore.radius + plate.margin, plate.kind, "hub_radius", middle,
            "the neck's wall must be at least a fifth of the thickness", "give a larger one, or a smaller bore");
    plate.bosses.push_back({Vec2::Zero(), middle, layout.number("hub_height"), layout.uniform(0, 2 * pi)});
  }
  const int holes = layout.count("holes");
  const double pitch = layout.number("bolt_circle_radius");
  const PlateCut bolt = layout.drilled(layout.number("hole_radius"), 0, layout.number("countersunk"));
  check_bolt_circle(plate.kind, holes, pitch, bolt, plate.margin, "bolt_circle_radius");
  require(pitch - bolt.reach() >= middle + plate.margin && pitch + bolt.reach() + plate.margin <= plate.corner_radius,
          plate.kind, "bolt_circle_radius", pitch, "its holes must lie between the middle and the edge",
          "choose it between them, or smaller holes");
  layout.add_bolt_circle(Vec2::Zero(), holes, pitch, bolt);
  plate.cuts.push_back(bore);
  layout.add_decoys(0.5 * layout.number("hole_radius"));
  return finished(plate, values);
}

}  // namespace toposcope
