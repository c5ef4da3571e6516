// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "plugin/option_check.h"
#include "sample/sample.h"

namespace toposcope {

namespace {

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Json triples(const std::vector<Vec3>& points) {
  Json list = Json::array();
  for (const Vec3& p : points) list.push_back(triple(p));
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

Json group_json(const SampleFeature& feature, const MarkGroup& group) {
  std::vector<Vec3> points;
  std::vector<Index> vertices;
  for (const Index i : group.members) {
    points.push_back(feature.points[i]);
    vertices.push_back(feature.vertices[i]);
  }
  return {
      {"name", group.name}, {"vertices", vertices}, {"points", triples(points)}, {"centroid", triple(group.centroid)}};
}

Json feature_json(const SampleFeature& feature) {
  Json json = {{"vertices", feature.vertices}, {"points", triples(feature.points)}, {"shape", feature.shape}};
  if (feature.shape == "line-group") {
    json["groups"] = Json::array();
    for (const MarkGroup& group : feature.groups) json["groups"].push_back(group_json(feature, group));
  }
  json["parameters"] = Json::object();
  for (const auto& [name, values] : feature.parameters) json["parameters"][name] = parameter_value(name, values);
  return json;
}

Json scan_json(const ScanRecord& scan) {
  Json rotation = Json::array();
  for (const Vec3& row : scan.rotation) rotation.push_back(triple(row));
  return {{"viewpoints", scan.viewpoints},
          {"partial", scan.partial},
          {"noise_rel", scan.noise_rel},
          {"smoothing", scan.smoothing},
          {"spacing", scan.spacing},
          {"rotation", rotation},
          {"translation", triple(scan.translation)}};
}

/// A number, or the name of the choice that it stands for.
Json parameter_json(const std::string& kind_name, const std::string& name, double value) {
  for (const SampleKind& kind : sample_kinds())
    for (const OptionRow& row : kind.parameters)
      if (kind.name == kind_name && row.name == name && row.type == OptionType::text)
        return option_choices(row).at(static_cast<std::size_t>(value));
  return value;
}

}  // namespace

std::string truth_json(const Sample& sample, const std::string& mesh_file) {
  Json json = {{"schema", "toposcope.truth/1"}, {"mesh", mesh_file}, {"class", sample.kind}};
  json["features"] = Json::object();
  for (const SampleFeature& feature : sample.features) json["features"][feature.name] = feature_json(feature);
  json["parts"] = Json::object();
  for (std::size_t part = 0; part < sample.part_names.size(); ++part) {
    std::vector<std::size_t> faces;
    for (std::size_t f = 0; f < sample.face_part.size(); ++f)
      if (sample.face_part[f] == part) faces.push_back(f);
    json["parts"][sample.part_names[part]] = faces;
  }
  Json parameters = Json::object();
  for (const auto& [name, value] : sample.parameters) parameters[name] = parameter_json(sample.kind, name, value);
  json["sample"] = {
      {"kind", sample.kind}, {"parameters", parameters}, {"noise_rel", sample.noise_rel}, {"seed", sample.seed}};
  if (sample.scan) json["sample"]["scan"] = scan_json(*sample.scan);
  return json.dump(1) + "\n";
}

}  // namespace toposcope
