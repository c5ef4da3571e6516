// SPDX-License-Identifier: BSD-3-Clause

// What the program writes keeps to the published schemas.

#include <gtest/gtest.h>

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

std::string faults(const std::string& schema_name, const json& document) {
  const json schema_json =
      json::parse(read_text(std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "schemas" / (schema_name + ".schema.json")));
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::ValidationResults results;
  valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results);
  std::string text;
  for (valijson::ValidationResults::Error error; results.popError(error);) {
    for (const std::string& step : error.context) text += step;
    text += ": " + error.description + "\n";
  }
  return text;
}

TEST(ResultSchema, HoldsForFoundMissingAndClassifiedFeatures) {
  const TemporaryFolder folder;
  const std::string cup = (folder / "cup.ply").string(), tee = (folder / "tee.ply").string();
  ASSERT_EQ(toposcope("sample cup --faces 5000 --set handle=false -o " + cup).exit_code, 0);
  ASSERT_EQ(toposcope("sample tee --faces 5000 -o " + tee).exit_code, 0);
  for (const std::string& command : {cup + " --model cup", tee + " --model pipe-fitting", tee + " --model airplane",
                                     cup + " --model neal-1999/cup --pipeline neal-1999"}) {
    const Outcome outcome = toposcope("run " + command + " --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(faults("result", json::parse(outcome.out)), "") << command;
  }
  json broken = json::parse(toposcope("run " + cup + " --model cup --json").out);
  EXPECT_FALSE(broken["features"]["handleCon"]["present"].get<bool>());
  broken["features"]["rim"].erase("probability");
  EXPECT_NE(faults("result", broken), "");
  EXPECT_EQ(faults("truth", json::parse(read_text(folder / "cup.truth.json"))), "");
}

}  // namespace
}  // namespace toposcope::test
