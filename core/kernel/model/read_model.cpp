// SPDX-License-Identifier: BSD-3-Clause
#include "model/read_model.h"

#include "base/schemas.h"
#include "base/text_file.h"
#include "model/model_reading.h"
#include "model/yaml_json.h"

namespace toposcope {
namespace {

std::string text_of(const YAML::Node& node) {
  return node ? node.Scalar() : std::string();
}

}  // namespace

Model model_from_text(const std::string& text, const std::string& file, const PluginCatalog* catalog) {
  const YAML::Node root = parse_yaml(text, file);
  ErrorList errors;
  check_schema(root, model_schema(), file, errors);
  errors.throw_if_any();

  const ModelReading reading{file, catalog, errors};
  if (!root["features"] && !root["objects"])
    reading.add(root, "the model says nothing: add 'features' to find, or 'objects' to reason with");
  Model model;
  model.name = text_of(root["name"]);
  model.summary = text_of(root["summary"]);
  model.citation = text_of(root["citation"]);
  if (const YAML::Node pipeline = root["pipeline"]) {
    model.pipeline = pipeline.Scalar();
    model.pipeline_where = reading.at(pipeline);
  }
  model.file = file;
  model.document = yaml_to_json(root, file, errors).value.dump();
  model.abstract = read_abstract_model(root, reading);
  model.features = read_features(root, model.abstract, reading);
  model.relationships = read_relationships(root, model.features, reading);
  model.classes = read_classes(root, model.relationships, reading);
  model.measures = read_measures(root, model.features, reading);
  model.axes = read_axes(root, model.features, reading);
  check_families(root, model, reading);
  errors.throw_if_any();
  refuse_contrary_orders(model, reading);
  errors.throw_if_any();
  add_implied(root, reading, model);
  return model;
}

Model read_model(const std::filesystem::path& file, const PluginCatalog* catalog) {
  return model_from_text(read_text_file(file, "model"), file.string(), catalog);
}

}  // namespace toposcope
