// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kernel/model/sound_model.h"

namespace toposcope {
namespace {

using test::Change;
using test::sound_model;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using ModelErrors = test::ReadModel;

TEST_F(ModelErrors, AbstractModelErrors) {
  const Change changes[] = {
      {"body: [wall, floor]", "body: [wall, rimLine]", "11:16",
       "'body' (volume) cannot be bounded by 'rimLine' (line); a volume is bounded by a surface"},
      {"cup: [body]", "cup: [wall]", "14:9", "'cup' (volume) cannot have 'wall' (surface) as its part"},
      {"[wall, floor]", "[wal, floor]", "11:10", "there is no object 'wal' under objects; did you mean 'wall'?"},
      {"  body: [wall", "  bodi: [wall", "11:3", "no object 'bodi'"},
      {"up: edgeLine", "up: edgLine", "16:25", "did you mean 'edgeLine'?"},
      {"up: edgeLine", "up: rimLine", "16:25", "'rimLine' cannot be up of itself"},
      {"[wall, floor]", "[wall, floor, wall]", "11:23", "follows from line 11 already"},
      {"up: edgeLine}", "up: edgeLine}\n  - {from: edgeLine, down: rimLine}", "17:28", "follows from line 16 already"},
      {"up: edgeLine}", "up: edgeLine}\n  - {from: edgeLine, up: rimLine}", "17:26",
       "cycle: 'rimLine' up 'edgeLine' up 'rimLine'"},
      {"up: edgeLine}", "up: edgeLine}\n  - {from: rimLine, down: edgeLine}", "17:27",
       "cycle: 'rimLine' up 'edgeLine' up 'rimLine'"},
      {"cup: [body]", "cup: [body]\n  body: [cup]", "15:10", "cycle: 'cup' has-part 'body' has-part 'cup'"},
      {"cup: [body]", "cup: [body, cup]", "14:15", "cycle: 'cup' has-part 'cup'"},
      {"parts:\n  cup: [body]\n", "", "5:3", "a second root, 'body' beside 'cup'"},
      {"realises: floor", "realises: flor", "27:22", "unknown object 'flor'; did you mean 'floor'?"},
      {"realises: floor, ", "", "27:3", "feature 'bottom' lacks 'realises'"},
  };
  for (const Change& change : changes) {
    const std::string error = error_with(change.from, change.to);
    EXPECT_THAT(error, HasSubstr(std::string("m.yaml:") + change.place + ": ")) << change.to;
    EXPECT_THAT(error, HasSubstr(change.says)) << change.to;
  }
}

TEST_F(ModelErrors, PointsHaveNoBoundary) {
  EXPECT_THAT(error_with("  edgeLine: line", "  edgeLine: line\n  tip: point\n  top: point") +
                  error_with("parts:", "  rimLine: [tip]\n  tip: [rimLine]\nparts:"),
              HasSubstr("there is no object 'tip'"));
  std::string text = sound_model;
  text.replace(text.find("  edgeLine: line"), 16, "  edgeLine: line\n  tip: point");
  text.replace(text.find("parts:"), 6, "  rimLine: [tip]\n  tip: [rimLine]\nparts:");
  EXPECT_EQ(error_of(text), "m.yaml:15:9: 'tip' (point) has no boundary: it is a point; remove the link");
}

TEST_F(ModelErrors, WorkingModelErrors) {
  const Change changes[] = {
      {"[rim, edge]", "[rim, edg]", "29:24", "unknown feature 'edg'; did you mean 'edge'?"},
      {"[rim, edge]", "[rim, rim]", "29:24", "names feature 'rim' twice"},
      {"plain: [r1]", "plain: [r9]", "32:11", "unknown relationship 'r9'"},
      {"plain: [r1]", "plain: [r1, r1]", "32:15", "names relationship 'r1' twice"},
      {"plain: [r1]", "plain: [r1, r2]", "33:3", "the same relationships as class 'plain'"},
      {"bb(w).c/2 < r", "bb(w).c/2 + 1 < r", "23:25", "cannot add a length and a number"},
      {"bb(O).a/20", "bb(O).a*bb(O).a", "24:20", "is an area, but must be a length"},
      {"bb(O).a/20", "0", "24:20", "is a number, but must be a length"},
      {"bb(O).a/20", "bb(O).x/20", "24:26", "sides a, b and c"},
      {"max: bb(O).c/4", "max: bb(O).c/0", "30:72", "division by zero"},
  };
  for (const Change& change : changes) {
    for (const bool with_catalog : {true, false}) {
      const std::string error = error_with(change.from, change.to, with_catalog);
      EXPECT_THAT(error, StartsWith(std::string("m.yaml:") + change.place + ": ")) << change.to;
      EXPECT_THAT(error, HasSubstr(change.says)) << change.to;
    }
  }
}

TEST_F(ModelErrors, ErrorsThatPluginsTell) {
  const Change changes[] = {
      {"[planar]", "[planer]", "27:40", "no working-set plugin provides the type 'planer'; did you mean 'planar'?"},
      {"shape: circle", "shape: circel", "21:12", "did you mean 'circle'?"},
      {"[convex]\n", "[convex, concave]\n", "21:12", "gives shape 'circle' 2 working sets; it takes 1"},
      {"realises: rimLine\n", "realises: wall\n", "19:15",
       "feature 'rim' realises 'wall', which is a surface, by shape 'circle', which is a line; name"},
      {"realises: floor", "realises: rimLine", "27:22", "which is a line, by shape 'plane', which is a surface"},
      {"realises: floor", "realises: body", "27:22", "which is a volume"},
      {"radius: bb", "radus: bb", "23:7", "shape 'circle' has no measure 'radus'; did you mean 'radius'?"},
      {"radius: bb", "length_1: bb", "23:7", "shape 'circle' has no measure 'length_1'"},
      {"r < bb(O).a", "r < bb(O).a*bb(O).b", "23:31", "is an area, but 'r' is a length"},
      {"segments: 3", "segments: 0", "26:97", "segments"},
      {"segments: 3", "segment: 3", "26:96", "did you mean 'segments'?"},
      {"closed: true", "closed: 3", "26:108", "true or false"},
      {"type: concentric", "type: concentrik", "29:37", "did you mean 'concentric'?"},
      {"[rim, edge]", "[rim, edge, bottom]", "29:18", "gives relation 'concentric' 3 features; it takes 2"},
      {"max: bb(O).c/4", "maxx: bb(O).c/4", "30:59", "has no argument 'maxx'; did you mean 'max'?"},
      {", max: bb(O).c/4", "", "30:3", "lacks 'max', which relation 'centroid-distance' needs; add it: greatest"},
      {"max: bb(O).c/4", "max: 4", "30:64", "'max' is a length, but '4' is a number"},
      {"max: bb(O).c/4", "max: bb(O).c*bb(O).c", "30:64", "'max' is a length, but 'bb(O).c*bb(O).c' is an area"},
      {"max: bb(O).c/4", "max: bb(w).c", "30:64", "names bb(w)"},
      {"type: concentric", "type: angle, angle: 270", "29:51", "from 0 to 180"},
      {"type: concentric", "type: angle, angle: bb(O).a", "29:51", "'angle' is a number"},
      {"type: concentric", "type: concentric, tolerance: bb(O).a", "29:60", "'tolerance' is a number"},
      {"type: concentric", "type: concentric, tolerance: 0", "29:60", "tolerance"},
      {"type: concentric", "type: concentric, tolerance: 1 +", "29:63", "the expression ends"},
      {"type: concentric", "type: angle, signed: 3", "29:52", "write true or false"},
  };
  for (const Change& change : changes) {
    const std::string error = error_with(change.from, change.to);
    EXPECT_THAT(error, HasSubstr(std::string("m.yaml:") + change.place + ": ")) << change.to;
    EXPECT_THAT(error, HasSubstr(change.says)) << change.to;
  }
  EXPECT_EQ(error_with("type: concentric", "type: angle, angle: 30 + 60, signed: true"), "no error");
  EXPECT_EQ(error_with("max: bb(O).c/4", "min: 0, max: bb(O).c/4"), "no error") << "0 fits a length";
}

TEST_F(ModelErrors, EveryRelationshipMaySetItsTolerance) {
  std::string text = sound_model;
  text.replace(text.find("type: concentric"), 16, "type: concentric, tolerance: 40/2");
  const Model model = model_from_text(text, "m.yaml", &catalog_);
  ASSERT_TRUE(model.relationships[0].tolerance);
  EXPECT_EQ(model.relationships[0].tolerance->evaluate({}), 20);
  EXPECT_TRUE(model.relationships[0].arguments.empty()) << "it is no argument of the plugin";
  EXPECT_FALSE(model.relationships[1].tolerance);
}

TEST_F(ModelErrors, TellsAllErrorsInTheOrderOfTheFile) {
  std::string text = sound_model;
  text.replace(text.find("[rim, edge]"), 11, "[rim, egde]");
  text.replace(text.find("[wall, floor]"), 13, "[wall, flor]");
  text.replace(text.find("shape: circle"), 13, "shape: disk");
  const std::string error = error_of(text);
  const std::size_t first = error.find("m.yaml:11:16: "), second = error.find("\nm.yaml:21:12: "),
                    third = error.find("\nm.yaml:29:24: ");
  ASSERT_NE(first, std::string::npos) << error;
  ASSERT_NE(second, std::string::npos) << error;
  ASSERT_NE(third, std::string::npos) << error;
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 2) << error;
}

}  // namespace
}  // namespace toposcope
