// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/option_check.h"
#include "sample/sample.h"
#include "truth/features_json.h"

namespace toposcope {

namespace {

using Json = nlohmann::ordered_json;

Json scan_json(const ScanRecord& scan) {
  Json rotation = Json::array();
  for (const Vec3& row : scan.rotation) rotation.push_back(triple_json(row));
  return {{"viewpoints", scan.viewpoints},
          {"partial", scan.partial},
          {"noise_rel", scan.noise_rel},
          {"smoothing", scan.smoothing},
          {"spacing", scan.spacing},
          {"rotation", rotation},
          {"translation", triple_json(scan.translation)}};
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
  Json json = {{"schema", "toposcope.truth/1"}, {"mesh", mesh_file}, {"class", sample.truth.class_name}};
  json["features"] = features_json(sample.truth.features);
  json["parts"] = Json::object();
  for (std::size_t part = 0; part < sample.part_names.size(); ++part) {
    std::vector<std::size_t> faces;
    for (std::size_t f = 0; f < sample.face_part.size(); ++f)
      if (sample.face_part[f] == part) faces.push_back(f);
    json["parts"][sample.part_names[part]] = faces;
  }
  Json parameters = Json::object();
  for (const auto& [name, value] : sample.parameters)
    parameters[name] = parameter_json(sample.truth.class_name, name, value);
  json["sample"] = {{"kind", sample.truth.class_name},
                    {"parameters", parameters},
                    {"noise_rel", sample.noise_rel},
                    {"seed", sample.seed}};
  if (sample.scan) json["sample"]["scan"] = scan_json(*sample.scan);
  return json.dump(1) + "\n";
}

}  // namespace toposcope
