// SPDX-License-Identifier: BSD-3-Clause

// What the program writes keeps to the published schemas.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/program.h"
#include "support/schemas.h"

namespace toposcope::test {
namespace {

using nlohmann::json;

/// Members of type number that do not say what they are, by their JSON pointers.
std::string silent_numbers(const json& node, const std::string& place) {
  std::string found;
  if (node.is_object() && node.contains("properties"))
    for (const auto& [name, member] : node["properties"].items())
      if (member.contains("type") && member["type"].dump().find("\"number\"") != std::string::npos &&
          !member.contains("description"))
        found += place + "/properties/" + name + "\n";
  if (node.is_structured())
    for (const auto& [name, child] : node.items()) found += silent_numbers(child, place + "/" + name);
  return found;
}

TEST(Schemas, NameThemselvesAndSayWhatTheirNumbersAre) {
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "schemas")) {
    const json schema = json::parse(read_text(entry.path()));
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(schema["$id"], "https://toposcope.org/schemas/" + name);
    for (const char* member : {"title", "description"}) EXPECT_TRUE(schema.contains(member)) << name << ": " << member;
    EXPECT_EQ(silent_numbers(schema, ""), "") << name;
    ++count;
  }
  EXPECT_GE(count, 10U);
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
    EXPECT_EQ(schema_faults("result", outcome.out), "") << command;
  }
  write_text(folder / "m.yaml",
             "schema: toposcope.model/1\nname: m\nfeatures:\n"
             "  rim: {worksets: [convex], shape: circle, ranges: {radius: bb(O).a/4 < r < bb(O).a/2}}\n"
             "  bottom: {worksets: [planar], shape: plane, max_fit_error: bb(O).c/50}\n"
             "  none: {worksets: [planar], shape: plane, ranges: {extent: 2*bb(O).a < e}}\n"
             "measures: {height: \"distance(rim, bottom)\", tilt: \"angle(rim, none)\"}\n");
  const Outcome measured = toposcope("run " + cup + " --model " + (folder / "m.yaml").string() + " --json --measures " +
                                     (folder / "m.csv").string() + " --features " + (folder / "f.csv").string());
  EXPECT_EQ(schema_faults("result", measured.out), "");
  const json measures = json::parse(measured.out)["measures"];
  EXPECT_GT(measures["height"]["sd"], 0);
  EXPECT_EQ(measures["tilt"]["why"], "'none' is missing");
  EXPECT_EQ(read_text(folder / "m.csv").substr(0, 40), "mesh,height,height_sd,tilt,tilt_sd\n" + cup.substr(0, 5));
  const std::string features = read_text(folder / "f.csv");
  EXPECT_EQ(features.find("mesh,feature,shape,probability,fit_error,x,y,z,direction_x"), 0U);
  EXPECT_NE(features.find(cup + ",rim,circle,"), std::string::npos);
  EXPECT_EQ(std::count(features.begin(), features.end(), '\n'), 3) << "a head, and the two that were found";
  EXPECT_NE(measured.out.find("\"bound\":\"2*bb(O).a < extent\""), std::string::npos);
  json broken = json::parse(toposcope("run " + cup + " --model cup --json").out);
  EXPECT_FALSE(broken["features"]["handleCon"]["present"].get<bool>());
  broken["features"]["rim"].erase("probability");
  EXPECT_NE(schema_faults("result", broken.dump()), "");
  EXPECT_EQ(schema_faults("truth", read_text(folder / "cup.truth.json")), "");
}

TEST(JsonOutput, OfEveryCommandKeepsToASchema) {
  const TemporaryFolder folder;
  const std::string cup = (folder / "cup.ply").string(), problem = (folder / "cup.json").string();
  ASSERT_EQ(toposcope("sample cup --faces 3000 -o " + cup).exit_code, 0);
  ASSERT_EQ(toposcope("run " + cup + " --model cup -q --save-problem " + problem).exit_code, 0);
  const std::pair<const char*, std::string> commands[] = {
      {"result", "run " + cup + " --model cup --json"},
      {"classification", "classify " + cup + " --models cup,pipe-fitting --json"},
      {"preparation", "prepare " + cup + " --json"},
      {"preparation", "prepare " + cup + " --decimate 1000 --json -o " + (folder / "few.ply").string()},
      {"labeling", "label " + problem + " --json --marginals --k-best 3"},
      {"labeling", "label " + problem + " --json --labeler discrete-relaxation"},
      {"comparison", "compare " + cup + " --model cup --labelers least-error,annealing --json"},
      {"plugins", "plugins list --json"},
      {"plugin", "plugins describe circle --json"},
      {"check", "plugins check --json " TOPOSCOPE_BUILD_DIR "/plugins/relations/parallel.so"}};
  for (const auto& [schema, command] : commands) {
    const Outcome outcome = toposcope(command);
    EXPECT_EQ(outcome.exit_code, 0) << command << outcome.err;
    EXPECT_EQ(schema_faults(schema, outcome.out), "") << command;
    json broken = json::parse(outcome.out);
    broken.erase("schema");
    EXPECT_NE(schema_faults(schema, broken.dump()), "") << schema;
  }
}

}  // namespace
}  // namespace toposcope::test
