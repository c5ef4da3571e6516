// SPDX-License-Identifier: BSD-3-Clause
#include "sample/sample.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "plugin/option_check.h"
#include "sample/draw.h"
#include "sample/isosurface.h"
#include "sample/remesh.h"
#include "sample/solid.h"

namespace toposcope {

namespace {

struct Maker {
  SampleKind (*kind)();
  Solid (*make)(const ParameterValues&);
};
constexpr Maker makers[] = {{cup_kind, make_cup},          {tee_kind, make_tee},     {wye_kind, make_wye},
                            {cross_kind, make_cross},      {elbow_kind, make_elbow}, {tricorner_kind, make_tricorner},
                            {airplane_kind, make_airplane}};

double to_number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);  // not strtod: it follows the locale
  return value;
}

const SampleKind& find_kind(const std::vector<SampleKind>& kinds, const std::string& name) {
  std::vector<std::string> names;
  for (const SampleKind& kind : kinds) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw UsageError(fmt::format("sample kind '{}' is not known: {}", name, name_remedy(name, names)));
}

void check_request(const SampleRequest& request) {
  if (request.faces < 500 || request.faces > 2000000)
    throw UsageError(fmt::format("{}: faces is {}: it must lie between 500 and 2000000; the default is 20000",
                                 request.kind, request.faces));
  if (!(request.noise_rel >= 0 && request.noise_rel <= 0.1))
    throw UsageError(fmt::format("{}: noise is {} box diagonals: it must lie between 0 and 0.1, such as 0.001",
                                 request.kind, request.noise_rel));
  if (request.random && !request.preset.empty())
    throw UsageError(fmt::format("{}: preset '{}' and random parameters exclude each other: leave one out",
                                 request.kind, request.preset));
}

/// Faces that look inwards: where a net was drawn onto a surface that is too far from it, or too bent.
bool is_folded(const TriangleSoup& mesh, const Implicit& surface, Context& context) {
  std::vector<Vec3> normals(mesh.positions.size());
  context.parallel_for(normals.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) normals[v] = surface(mesh.positions[v]).gradient;
  });
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const Vec3 &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
    return (q - p).cross(r - p).dot(normals[t[0]] + normals[t[1]] + normals[t[2]]) < 0;
  });
}

/// A net that resolves the solid's thinnest part and has more faces than asked for. Thin material comes out whole on a
/// coarser grid when the net is laid a little outside it; but gaps become narrower there, and hollows may fold.
TriangleSoup fine_net(const Solid& solid, const SampleRequest& request, Context& context) {
  // Of the thickness at the level: below 1 / sqrt(3) no cell meets both sides of a wall.
  constexpr double cell = 0.55;
  double level = net_level(solid);
  double spacing = cell * (solid.thinnest + 2 * level);
  for (int attempt = 0; attempt < 10; ++attempt) {
    TriangleSoup fine;
    try {
      fine = extract_isosurface(solid.surface, solid.low, solid.high, spacing, level, context);
    } catch (const std::length_error&) {
      throw UsageError(fmt::format("{}: {} is {}: too thin for the object's size to be meshed; give more", request.kind,
                                   solid.thinnest_parameter, solid.thinnest));
    }
    const double found = static_cast<double>(fine.triangles.size()), wanted = request.faces;
    if (found < 1.2 * wanted) {
      spacing *= std::sqrt(found / (1.35 * wanted));
      level = std::clamp((spacing / cell - solid.thinnest) / 2, 0.0, level);
    } else if (!is_closed_manifold(fine)) {
      spacing *= 0.87;  // two sheets meet in one cell
    } else if (level > 0 && is_folded(fine, solid.surface, context)) {
      level = level > 0.1 * solid.thinnest ? 0.5 * level : 0;
      spacing = std::min(spacing, cell * (solid.thinnest + 2 * level));
    } else {
      return fine;
    }
  }
  return {};
}

/// Meshes the solid by a fine net, and thins that.
TriangleSoup mesh_solid(const Solid& solid, const SampleRequest& request, Context& context) {
  const double faces = request.faces;
  const TriangleSoup fine = fine_net(solid, request, context);
  if (fine.triangles.empty())
    throw UsageError(fmt::format("{}: {} is {}: no grid resolves the object; give more", request.kind,
                                 solid.thinnest_parameter, solid.thinnest));
  TriangleSoup mesh = remesh(fine, solid.surface, request.faces, context);
  if (static_cast<double>(mesh.triangles.size()) > 1.03 * faces)
    throw UsageError(fmt::format("{}: faces is {}: the object's curved parts need at least {} faces; ask for more",
                                 request.kind, request.faces, mesh.triangles.size()));
  return mesh;
}

/// Standard normal numbers in pairs (Box and Muller 1958): std::normal_distribution differs between libraries.
struct Gaussian {
  std::mt19937_64 engine;
  double spare = 0;
  bool has_spare = false;

  double uniform() { return (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53; }
  double operator()() {
    if (has_spare) {
      has_spare = false;
      return spare;
    }
    const double radius = std::sqrt(-2 * std::log(uniform())), angle = 2 * pi * uniform();
    spare = radius * std::sin(angle);
    has_spare = true;
    return radius * std::cos(angle);
  }
};

void add_noise(std::vector<Vec3>& positions, const Implicit& surface, const SampleRequest& request) {
  Vec3 low = positions.front(), high = low;
  for (const Vec3& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double sd = request.noise_rel * (high - low).norm();
  Gaussian gaussian{std::mt19937_64(request.seed)};
  for (Vec3& p : positions) p += sd * gaussian() * surface(p).gradient.normalized();
}

}  // namespace

void mark_vertices(SampleFeature& feature, const std::vector<Vec3>& positions) {
  std::set<Index> taken;
  std::vector<Vec3> points;
  std::vector<Index> renumbered(feature.points.size());
  std::vector<bool> kept(feature.points.size(), false);
  for (std::size_t i = 0; i < feature.points.size(); ++i) {
    const auto distance = [&](const Vec3& p) { return (p - feature.points[i]).squaredNorm(); };
    const auto nearest = std::min_element(positions.begin(), positions.end(),
                                          [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
    const auto vertex = static_cast<Index>(nearest - positions.begin());
    if (!taken.insert(vertex).second) continue;
    kept[i] = true;
    renumbered[i] = static_cast<Index>(points.size());
    points.push_back(feature.points[i]);
    feature.vertices.push_back(vertex);
  }
  feature.points = std::move(points);
  for (MarkGroup& group : feature.groups) {
    std::erase_if(group.members, [&](Index i) { return !kept[i]; });
    for (Index& i : group.members) i = renumbered[i];
  }
}

OptionRow length_parameter(const char* name, const char* default_value, const char* minimum, const char* meaning) {
  return {name, OptionType::real, "length", default_value, minimum, "", meaning};
}

OptionRow angle_parameter(const char* name, const char* default_value, const char* meaning) {
  return {name, OptionType::real, "degrees", default_value, "-180", "180", meaning};
}

OptionRow switch_parameter(const char* name, const char* default_value, const char* meaning) {
  return {name, OptionType::boolean, "", default_value, "", "", meaning};
}

double parameter_number(const OptionRow& row, const std::string& text) {
  if (row.type == OptionType::boolean) return text == "true" ? 1 : 0;
  const std::vector<std::string> choices = option_choices(row);
  if (choices.empty()) return to_number(text);
  return static_cast<double>(std::find(choices.begin(), choices.end(), text) - choices.begin());
}

double parameter(const ParameterValues& values, std::string_view name) {
  for (const auto& [key, value] : values)
    if (key == name) return value;
  throw std::logic_error("no parameter '" + std::string(name) + "' in the kind's table");
}

void require(bool holds, const std::string& kind, const std::string& name, double value, const std::string& constraint,
             const std::string& remedy) {
  if (!holds) throw UsageError(fmt::format("{}: {} is {}: {}; {}", kind, name, value, constraint, remedy));
}

SampleFeature circle_feature(const std::string& name, const Vec3& center, const Vec3& normal, double radius,
                             std::size_t count) {
  SampleFeature feature{name, "circle", {}, {}, {}, {}};
  feature.parameters = {{"center", {center.x(), center.y(), center.z()}},
                        {"normal", {normal.x(), normal.y(), normal.z()}},
                        {"radius", {radius}}};
  const Vec3 u = (std::abs(normal.z()) < 0.9 ? normal.cross(Vec3::UnitZ()) : normal.cross(Vec3::UnitX())).normalized();
  const Vec3 v = normal.cross(u);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
    feature.points.push_back(center + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return feature;
}

ParameterValues check_parameters(const SampleKind& kind, const std::map<std::string, double>& given) {
  ParameterValues values;
  std::vector<std::string> names;
  for (const OptionRow& row : kind.parameters) {
    const auto it = given.find(row.name);
    const std::vector<std::string> choices = option_choices(row);
    const double value = it == given.end() ? parameter_number(row, row.default_value) : it->second;
    if (!choices.empty())
      require(value >= 0 && value < static_cast<double>(choices.size()) && value == std::floor(value), kind.name,
              row.name, value, "it must be the number of a choice, from 0", "the default is " + row.default_value);
    else if (row.type == OptionType::boolean)
      require(value == 0 || value == 1, kind.name, row.name, value, "it must be true or false",
              "the default is " + row.default_value);
    else if (row.minimum.empty())
      require(std::isfinite(value), kind.name, row.name, value, "it must be a finite number",
              "the default is " + row.default_value);
    else if (row.unit == "length")
      require(std::isfinite(value) && value > to_number(row.minimum), kind.name, row.name, value,
              "it must be a finite number greater than " + row.minimum, "the default is " + row.default_value);
    else
      require(value >= to_number(row.minimum) && value <= to_number(row.maximum), kind.name, row.name, value,
              fmt::format("it must lie between {} and {}", row.minimum, row.maximum),
              "the default is " + row.default_value);
    values.emplace_back(row.name, value);
    names.push_back(row.name);
  }
  for (const auto& [name, value] : given)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError(fmt::format("{}: parameter '{}' (given {}) is not known: {}", kind.name, name, value,
                                   name_remedy(name, names)));
  return values;
}

std::vector<SampleKind> sample_kinds() {
  std::vector<SampleKind> kinds;
  for (const Maker& maker : makers) kinds.push_back(maker.kind());
  return kinds;
}

double sample_parameter(const SampleKind& kind, const std::string& name, const std::string& text) {
  const OptionValue value = check_option(kind.parameters, name, text, "sample '" + kind.name + "'");
  for (const OptionRow& row : kind.parameters)
    if (row.name == name && row.type == OptionType::text) return parameter_number(row, text);
  return value.number;
}

Solid make_solid(const std::string& kind, const ParameterValues& parameters) {
  for (const Maker& maker : makers)
    if (maker.kind().name == kind) return maker.make(parameters);
  throw std::logic_error("sample kind '" + kind + "' is listed but cannot be made");
}

ParameterValues requested_parameters(const SampleRequest& request) {
  const SampleKind kind = find_kind(sample_kinds(), request.kind);
  check_request(request);
  std::map<std::string, double> given = request.parameters;
  if (!request.preset.empty()) given = preset_parameters(kind, request.preset, given);
  if (request.random) given = draw_parameters(kind, given, request.seed);
  return check_parameters(kind, given);
}

Sample make_sample(const SampleRequest& request, Context& context) {
  Sample sample;
  sample.kind = request.kind;
  sample.parameters = requested_parameters(request);
  sample.noise_rel = request.noise_rel;
  sample.seed = request.seed;

  const Solid solid = make_solid(request.kind, sample.parameters);
  sample.mesh = mesh_solid(solid, request, context);
  const auto& triangles = sample.mesh.triangles;
  std::vector<Vec3>& positions = sample.mesh.positions;
  sample.mesh.input_faces = static_cast<Index>(triangles.size());
  for (Index f = 0; f < sample.mesh.input_faces; ++f) sample.mesh.face_origin.push_back(f);

  sample.features = solid.features;
  for (SampleFeature& feature : sample.features) mark_vertices(feature, positions);
  sample.part_names = solid.part_names;
  for (const Triangle& t : triangles) {
    const Vec3 center = (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3;
    sample.face_part.push_back(static_cast<std::uint8_t>(solid.part_of(center)));
  }
  if (request.noise_rel > 0) add_noise(positions, solid.surface, request);
  context.log(LogLevel::debug,
              fmt::format("{}: {} vertices, {} faces", request.kind, positions.size(), triangles.size()));
  return sample;
}

}  // namespace toposcope
