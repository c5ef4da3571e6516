// SPDX-License-Identifier: BSD-3-Clause
// What the abstract part of a model does to its runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "support/program.h"

namespace toposcope::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A cup of which the working part does not say which circle is the rim: either is above its bottom, or level with it.
std::string cup_model(const std::string& associations) {
  const bool bare = associations.empty();
  const auto realises = [&](const std::string& object) { return bare ? "" : "realises: " + object + ", "; };
  const std::string abstract = bare ? "" : R"(objects:
  cup: volume
  wall: surface
  floor: surface
  mouth: line
  foot: line
  grip: line
topology:
  cup: [wall, floor]
  wall: [mouth, foot, grip]
  floor: [foot]
associations:
)" + associations;
  return "schema: toposcope.model/1\nname: three\n" + abstract + "features:\n  rim: {" + realises("mouth") +
         R"(worksets: [convex], shape: circle, ranges: {radius: bb(w).c/2 < r < bb(O).a/2}}
  edge: {)" +
         realises("foot") + R"(worksets: [convex], shape: circle, ranges: {radius: bb(w).c/2 < r < bb(O).a/2}}
  bottom: {)" +
         realises("floor") + R"(worksets: [planar], shape: plane, max_fit_error: bb(O).c/50}
  handle:
    )" + (bare ? "" : "realises: grip\n    ") +
         R"(worksets: [concave, concave]
    shape: {plugin: line-group, segments: 1, ends: concave}
    ranges: {length: bb(O).a/4 < l < bb(O).a, end_size: 0 < s < bb(O).a/4, end_depth: 0.15 < d < 1}
    max_fit_error: bb(O).a/5
    detectability: 0.5
relationships:
  r1: {features: [rim, edge], type: concentric}
  r2: {features: [rim, bottom, handle], type: above}
)";
}

class AbstractPart : public ::testing::Test {
 protected:
  AbstractPart() { EXPECT_EQ(toposcope("sample cup --faces 3000 -o " + mesh()).exit_code, 0); }
  std::string mesh() const { return (folder / "cup.ply").string(); }
  std::string write(const std::string& text) const {
    write_text(folder / "three.yaml", text);
    return (folder / "three.yaml").string();
  }
  json run(const std::string& text) const {
    const Outcome outcome = toposcope("run " + mesh() + " --json --model " + write(text));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
  }
  TemporaryFolder folder;
};

constexpr const char* truth = "  - {from: mouth, up: grip}\n  - {from: grip, up: floor}\n";
constexpr const char* untruth = "  - {from: grip, up: floor}\n  - {from: floor, up: mouth}\n";

TEST_F(AbstractPart, GivesRelationshipsThatTellTheCirclesApart) {
  const json result = run(cup_model(truth));
  ASSERT_TRUE(result["features"]["rim"]["present"]);
  ASSERT_TRUE(result["features"]["edge"]["present"]);
  // The sample stands on z = 0.
  EXPECT_GT(result["features"]["rim"]["parameters"]["center"][2].get<double>(), 50);
  EXPECT_LT(result["features"]["edge"]["parameters"]["center"][2].get<double>(), 5);
  EXPECT_GT(result["features"]["rim"]["probability"].get<double>(), 0.7);
  std::string tested;
  for (const json& relation : result["relations"]) {
    EXPECT_TRUE(relation["satisfied"]) << relation.dump();
    tested += relation["name"].get<std::string>() + " " + relation["type"].get<std::string>() + " ";
  }
  EXPECT_EQ(tested, "r1 concentric r2 above a1 adjacent ");
}

TEST_F(AbstractPart, WithoutItTheyAreNot) {
  const json result = run(cup_model(""));
  EXPECT_EQ(result["relations"].size(), 2);
  EXPECT_LT(result["features"]["rim"]["probability"].get<double>(), 0.5);
  const json silent = run(cup_model(truth) + "implied: false\n");
  EXPECT_EQ(silent["features"], result["features"]) << "an abstract part that implies nothing changes nothing";
}

TEST_F(AbstractPart, AFalseOneIsRefused) {
  const std::string model = write(cup_model(untruth));
  for (const std::string& command : {"run " + mesh() + " --model " + model, "model check " + model}) {
    const Outcome outcome = toposcope(command);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(model + ":30:3: relationship 'r2' (above) puts 'mouth' up of 'floor'"),
                                   HasSubstr("lies down of it; change")));
  }
}

TEST_F(AbstractPart, ShowSaysWhatFollowsAndWhy) {
  const Outcome shown = toposcope("model show " + write(cup_model(truth)));
  EXPECT_THAT(shown.out, AllOf(HasSubstr("a1  adjacent(edge, bottom)  follows from floor bounded-by foot, line 13\n"),
                               HasSubstr("  by r2: up-down order of grip, floor, mouth\n")));
  const std::string said =
      cup_model(truth) +
      "  r3: {features: [edge, bottom], type: coplanar}\n  r4: {features: [bottom, edge], type: parallel}\n";
  EXPECT_THAT(toposcope("model show " + write(said)).out,
              AllOf(HasSubstr("  by r3: floor bounded-by foot, line 13\n"), Not(HasSubstr("adjacent("))));
}

/// Right, and not up to mirroring: T-tails too, of which the fin's corners are hidden.
TEST(Handedness, PortAndStarboardOfAirplanes) {
  const TemporaryFolder folder;
  for (const int seed : {2, 3, 6, 11}) {
    const std::string mesh = (folder / "airplane.ply").string();
    ASSERT_EQ(
        toposcope("sample airplane --random --faces 8000 --seed " + std::to_string(seed) + " -o " + mesh).exit_code, 0);
    const Outcome outcome = toposcope("run " + mesh + " --model airplane --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json result = json::parse(outcome.out);
    ASSERT_TRUE(result.contains("directions")) << seed;
    const json& directions = result["directions"];
    EXPECT_GT(directions["probability"].get<double>(), 0.6) << seed;
    // Of the samples port is +y, up +z, and the nose looks along +x.
    EXPECT_GT(directions["up"][2].get<double>(), 0.9) << seed;
    EXPECT_GT(directions["front"][0].get<double>(), 0.9) << seed;
    EXPECT_LT(directions["right"][1].get<double>(), -0.9) << seed;
    for (const auto& [name, side] : {std::pair{"pWingE", 1}, {"sWingE", -1}, {"pHzStabE", 1}, {"sHzStabE", -1}}) {
      const json& feature = result["features"][name];
      if (!feature["present"].get<bool>()) continue;
      EXPECT_GT(side * feature["parameters"]["endpoints"][1][1].get<double>(), 0) << seed << " " << name;
      EXPECT_LE(feature["probability"].get<double>(), directions["probability"].get<double>());
    }
  }
}

}  // namespace
}  // namespace toposcope::test
