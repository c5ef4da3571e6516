// SPDX-License-Identifier: BSD-3-Clause
#include "model/read_model.h"

#include <fstream>
#include <sstream>

#include "base/schemas.h"
#include "model/model_reading.h"

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
  Model model;
  model.name = text_of(root["name"]);
  model.summary = text_of(root["summary"]);
  model.citation = text_of(root["citation"]);
  model.file = file;
  model.abstract = read_abstract_model(root, reading);
  model.features = read_features(root, model.abstract, reading);
  model.relationships = read_relationships(root, model.features, reading);
  model.classes = read_classes(root, model.relationships, reading);
  errors.throw_if_any();
  return model;
}

Model read_model(const std::filesystem::path& file, const PluginCatalog* catalog) {
  std::ifstream stream(file, std::ios::binary);
  // A folder opens like a file and reads as empty.
  std::error_code ignored;
  if (!stream || std::filesystem::is_directory(file, ignored))
    throw UsageError("model '" + file.string() + "' cannot be read; check that it is a file and may be read");
  std::ostringstream text;
  text << stream.rdbuf();
  return model_from_text(text.str(), file.string(), catalog);
}

}  // namespace toposcope
