// SPDX-License-Identifier: BSD-3-Clause
#include "picture/stand.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/errors.h"

namespace toposcope {
namespace {

using nlohmann::json;

enum Axis { right_axis, front_axis, up_axis };

struct Direction {
  Axis axis;
  double sign;
};
const std::map<std::string, Direction> directions = {{"up", {up_axis, 1}},       {"down", {up_axis, -1}},
                                                     {"front", {front_axis, 1}}, {"back", {front_axis, -1}},
                                                     {"right", {right_axis, 1}}, {"left", {right_axis, -1}}};

/// All objects that an object holds, through its parts and its bounds, itself too.
std::set<std::string> held(const json& model, const std::string& object) {
  std::set<std::string> seen;
  std::vector<std::string> open = {object};
  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();
    if (!seen.insert(next).second) continue;
    for (const char* network : {"parts", "topology"})
      if (model.contains(network) && model[network].contains(next))
        for (const json& each : model[network][next]) open.push_back(each.get<std::string>());
  }
  return seen;
}

/// Middles of the features found, by name.
std::map<std::string, Vec3> places(const Scene& scene) {
  std::vector<Vec3> sums(scene.features.size(), Vec3::Zero());
  std::vector<double> counts(scene.features.size(), 0);
  for (std::size_t t = 0; t < scene.input.labels.size(); ++t) {
    const std::uint8_t label = scene.input.labels[t];
    if (label == 0 || label > sums.size()) continue;
    for (const Index v : scene.input.triangles[t]) sums[label - 1U] += scene.input.positions[v] / 3;
    ++counts[label - 1U];
  }
  std::map<std::string, Vec3> middles;
  for (std::size_t f = 0; f < sums.size(); ++f)
    if (counts[f] > 0) middles[scene.features[f]] = sums[f] / counts[f];
  return middles;
}

std::optional<Vec3> place_of(const json& model, const std::string& object, const std::map<std::string, Vec3>& places) {
  const std::set<std::string> inside = held(model, object);
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const auto& [name, feature] : model["features"].items())
    if (const auto at = places.find(name); at != places.end() && inside.contains(feature.value("realises", "")))
      sum += at->second, ++count;
  return count > 0 ? std::optional<Vec3>(sum / count) : std::nullopt;
}

struct Sum {
  Axis axis;
  Vec3 sum = Vec3::Zero();
  int sure = 0;  // associations of which both objects hold found features
};

std::array<Sum, 3> sums_of(const json& model, const std::map<std::string, Vec3>& places, const Vec3& middle) {
  std::array<Sum, 3> sums = {Sum{right_axis}, Sum{front_axis}, Sum{up_axis}};
  for (const json& association : model.value("associations", json::array()))
    for (const auto& [relation, to] : association.items()) {
      const auto direction = directions.find(relation);
      if (direction == directions.end()) continue;
      const std::optional<Vec3> from = place_of(model, association.value("from", ""), places);
      const std::optional<Vec3> other = place_of(model, to.get<std::string>(), places);
      if (!from && !other) continue;
      Sum& entry = sums[direction->second.axis];
      if (from && other) ++entry.sure;
      entry.sum += direction->second.sign * (from.value_or(middle) - other.value_or(middle));
    }
  return sums;
}

/// \throw UsageError  it is no model
json model_of(const Scene& scene) {
  json model = json::parse(scene.model);
  const auto refuse = [](const std::string& what) {
    throw UsageError("the scene's model is none: " + what + "; write the scene anew with toposcope run --out");
  };
  if (!model.is_object() || !model.contains("features") || !model["features"].is_object()) refuse("it has no features");
  for (const auto& [name, feature] : model["features"].items())
    if (!feature.is_object() || (feature.contains("realises") && !feature["realises"].is_string()))
      refuse("its feature '" + name + "' is no feature");
  for (const json& association : model.value("associations", json::array()))
    for (const auto& [relation, to] : association.items())
      if (!association.is_object() || !to.is_string()) refuse("'" + relation + "' of an association names no object");
  for (const char* network : {"parts", "topology"})
    if (model.contains(network))
      for (const auto& [object, held] : model[network].items())
        for (const json& each : held)
          if (!each.is_string()) refuse("'" + object + "' in " + network + " does not list names");
  return model;
}

Vec3 square_to(const Vec3& up, const Vec3& wanted) {
  return (wanted - wanted.dot(up) * up).normalized();
}

}  // namespace

Stand stand_of(const Scene& scene) {
  if (scene.model.empty()) return {};
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : scene.input.positions) middle += p / static_cast<double>(scene.input.positions.size());
  std::array<Sum, 3> sums = sums_of(model_of(scene), places(scene), middle);
  // A fin that is up of the fuselage lies far back too: what an axis has of a surer one is taken away.
  std::stable_sort(sums.begin(), sums.end(), [](const Sum& a, const Sum& b) { return a.sure > b.sure; });
  std::map<Axis, Vec3> found;
  for (const Sum& each : sums) {
    Vec3 sum = each.sum;
    for (const auto& [axis, direction] : found) sum -= sum.dot(direction) * direction;
    if (sum.norm() > 0.02 * each.sum.norm()) found[each.axis] = sum.normalized();
  }
  const auto has = [&](Axis axis) { return found.contains(axis); };
  if (!has(up_axis) && has(front_axis) && has(right_axis)) found[up_axis] = found[right_axis].cross(-found[front_axis]);
  if (!has(up_axis)) return {};
  Stand stand;
  stand.up = found[up_axis];
  if (has(front_axis)) {
    stand.front = found[front_axis];
  } else if (has(right_axis)) {
    stand.front = found[right_axis].cross(stand.up);
  } else {
    stand.front = square_to(stand.up, std::abs(stand.up.y()) < 0.8 ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ()));
  }
  return stand;
}

Stand stand_from(const std::string& up) {
  const std::string axis = up.starts_with('-') ? up.substr(1) : up;
  if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z')
    throw UsageError("--up " + up + ": expected auto, x, y, z, -x, -y or -z");
  Stand stand;
  stand.up = (up.size() == 2 ? -1 : 1) * Vec3::Unit(axis[0] - 'x');
  if (axis == "y") stand.front = stand.up.y() * Vec3::UnitZ();
  return stand;
}

}  // namespace toposcope
