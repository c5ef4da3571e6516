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

std::string schema_faults(const std::string& name, const std::string& document) {
  return schema_file_faults(std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "schemas" / (name + ".schema.json"),
                            document);
}

std::string schema_file_faults(const std::filesystem::path& file, const std::string& document) {
  using nlohmann::json;
  const json schema_json = json::parse(read_text(file));
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
