// SPDX-License-Identifier: BSD-3-Clause
#include "truth/features_json.h"

namespace toposcope {

namespace {

using Json = nlohmann::ordered_json;

Json triples(const std::vector<Vec3>& points) {
  Json list = Json::array();
  for (const Vec3& p : points) list.push_back(triple_json(p));
  return list;
}

Json parameter_value(const std::string& name, const std::vector<double>& values) {
  if (name == "closed") return values.front() != 0;
  if (values.size() == 1) return values.front();
  if (values.size() <= 3) return values;
  Json list = Json::array();
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) list.push_back({values[i], values[i + 1], values[i + 2]});
  return list;
}

Json group_json(const TruthFeature& feature, const TruthGroup& group) {
  std::vector<Vec3> points;
  std::vector<Index> vertices;
  for (const Index i : group.members) {
    points.push_back(feature.points[i]);
    vertices.push_back(feature.vertices[i]);
  }
  return {{"name", group.name},
          {"vertices", vertices},
          {"points", triples(points)},
          {"centroid", triple_json(group.centroid)}};
}

Json feature_json(const TruthFeature& feature) {
  Json json = {{"vertices", feature.vertices}, {"points", triples(feature.points)}, {"shape", feature.shape}};
  if (feature.shape == "line-group") {
    json["groups"] = Json::array();
    for (const TruthGroup& group : feature.groups) json["groups"].push_back(group_json(feature, group));
  }
  json["parameters"] = Json::object();
  for (const auto& [name, values] : feature.parameters) json["parameters"][name] = parameter_value(name, values);
  return json;
}

}  // namespace

Json features_json(const std::vector<TruthFeature>& features) {
  Json json = Json::object();
  for (const TruthFeature& feature : features) json[feature.name] = feature_json(feature);
  return json;
}

Json triple_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace toposcope
