// SPDX-License-Identifier: BSD-3-Clause
#include "support/schemas.h"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "support/program.h"

namespace toposcope::test {
namespace {

using nlohmann::json;

constexpr std::string_view published = "https://toposcope.org/schemas/";

std::filesystem::path schema_file(const std::string& name) {
  return std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "schemas" / name;
}

/// Takes the schemas that a node names into `taken`: the validator mistakes one document's definitions for those of
/// another.
/// \param root  where the definitions of the node's own document are
void take_in(json& node, const std::string& root, json& taken) {
  if (node.is_object() && node.contains("$ref")) {
    std::string& reference = node["$ref"].get_ref<std::string&>();
    std::string place = root;
    if (reference.starts_with(published)) {
      const std::string file = reference.substr(published.size(), reference.find('#') - published.size());
      place = "#/definitions/" + file;
      if (!taken.contains(file)) {
        taken[file] = nullptr;
        json other = json::parse(read_text(schema_file(file)));
        take_in(other, place, taken);
        taken[file] = std::move(other);
      }
    }
    const std::size_t pointer = reference.find('#');
    reference = place + (pointer == std::string::npos ? "" : reference.substr(pointer + 1));
  }
  if (node.is_structured())
    for (json& child : node) take_in(child, root, taken);
}

}  // namespace

std::string schema_faults(const std::string& name, const std::string& document) {
  return schema_file_faults(schema_file(name + ".schema.json"), document);
}

std::string schema_file_faults(const std::filesystem::path& file, const std::string& document) {
  json schema_json = json::parse(read_text(file));
  json taken = json::object();
  take_in(schema_json, "#", taken);
  for (auto& [name, other] : taken.items()) schema_json["definitions"][name] = other;
  const json checked = json::parse(document);
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::ValidationResults results;
  valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(checked), &results);
  std::string text;
  for (valijson::ValidationResults::Error error; results.popError(error);) {
    for (const std::string& step : error.context) text += step;
    text += ": " + error.description + "\n";
  }
  return text;
}

}  // namespace toposcope::test
