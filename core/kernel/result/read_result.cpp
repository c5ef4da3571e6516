// SPDX-License-Identifier: BSD-3-Clause
#include "result/read_result.h"

#include <limits>

#include "base/errors.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "result/shape_json.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

double number(const Json& node) {
  return node.is_null() ? std::numeric_limits<double>::quiet_NaN() : node.get<double>();
}

StoredFeature feature_from(const std::string& name, const Json& node) {
  StoredFeature feature;
  feature.name = name;
  feature.present = node.at("present").get<bool>();
  feature.probability = number(node.at(feature.present ? "probability" : "probability_missing"));
  if (!feature.present) return feature;
  feature.shape = node.at("shape").get<std::string>();
  feature.parameters = parameters_from(node.at("parameters"));
  feature.faces = node.at("faces").get<std::vector<Index>>();
  return feature;
}

}  // namespace

StoredResult read_result(const std::filesystem::path& file) {
  StoredResult result;
  result.text = read_text_file(file, "result");
  try {
    const Json root = parse_json<Json>(result.text, file.string());
    if (root.value("schema", "") != "toposcope.result/1")
      throw UsageError(file.string() + ": 'schema' is not toposcope.result/1; give what toposcope run --out wrote");
    result.mesh = root.at("mesh").at("path").get<std::string>();
    result.mesh_hash = root.at("mesh").at("sha256").get<std::string>();
    result.model = root.at("model").get<std::string>();
    for (const auto& [name, node] : root.at("features").items()) result.features.push_back(feature_from(name, node));
  } catch (const Json::exception& error) {
    throw UsageError(file.string() + ": is no result: " + json_fault(error) +
                     "; give what toposcope run --out wrote (schemas/result.schema.json)");
  }
  return result;
}

}  // namespace toposcope
