// SPDX-License-Identifier: BSD-3-Clause
#include "model/read_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "core/kernel/model/model_catalog.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Line numbers are what the tests below count on.
const std::string sound = R"(schema: toposcope.model/1
name: cup
objects:
  cup: volume
  body: volume
  wall: surface
  floor: surface
  rimLine: line
  edgeLine: line
topology:
  body: [wall, floor]
  wall: [rimLine, edgeLine]
parts:
  cup: [body]
associations:
  - {from: rimLine, up: edgeLine}
features:
  rim:
    realises: rimLine
    worksets: [convex]
    shape: circle
    ranges:
      radius: bb(w).c/2 < r < bb(O).a
    max_fit_error: bb(O).a/20
    detectability: 0.75
  edge: {realises: edgeLine, worksets: [convex, concave], shape: {plugin: line-group, segments: 3, closed: true}}
  bottom: {realises: floor, worksets: [planar], shape: plane}
relationships:
  r1: {features: [rim, edge], type: concentric}
  r2: {features: [edge, bottom], type: centroid-distance, max: bb(O).c/4}
classes:
  plain: [r1]
  full: [r2, r1]
)";

class ReadModel : public ::testing::Test {
 protected:
  std::string error_of(const std::string& text, bool with_catalog = true) const {
    try {
      model_from_text(text, "m.yaml", with_catalog ? &catalog_ : nullptr);
      return "no error";
    } catch (const UsageError& error) {
      EXPECT_EQ(error.exit_code, 2);
      return error.what();
    }
  }
  /// The error of the sound model with one place changed.
  std::string error_with(const std::string& from, const std::string& to, bool with_catalog = true) const {
    std::string text = sound;
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << "the sound model has no " << from;
    return error_of(text.replace(place, from.size(), to), with_catalog);
  }

  PluginCatalog catalog_ = test::ModelCatalog().read();
};

TEST_F(ReadModel, ReadsEveryPart) {
  ASSERT_TRUE(catalog_.problems().empty()) << catalog_.problems()[0].message;
  const Model model = model_from_text(sound, "m.yaml", &catalog_);
  EXPECT_EQ(model.name, "cup");
  EXPECT_EQ(model.file, "m.yaml");

  ASSERT_EQ(model.abstract.objects.size(), 6u);
  EXPECT_EQ(model.abstract.objects[2].name, "wall");
  EXPECT_EQ(model.abstract.objects[2].dimension, 2);
  EXPECT_EQ(model.abstract.objects[2].where.str(), "m.yaml:6:3");
  EXPECT_EQ(model.abstract.root, 0u);
  ASSERT_EQ(model.abstract.topology.size(), 4u);
  EXPECT_EQ(model.abstract.topology[3].from, 2u);
  EXPECT_EQ(model.abstract.topology[3].to, 5u);
  EXPECT_EQ(model.abstract.parts.size(), 1u);
  ASSERT_EQ(model.abstract.associations.size(), 1u);
  EXPECT_EQ(model.abstract.associations[0].kind, "up");

  ASSERT_EQ(model.features.size(), 3u) << "in the order of the file";
  const ModelFeature& rim = model.features[0];
  EXPECT_EQ(rim.name, "rim");
  EXPECT_EQ(rim.realises, "rimLine");
  EXPECT_EQ(rim.shape.plugin, "circle");
  EXPECT_EQ(rim.detectability, 0.75);
  ASSERT_EQ(rim.ranges.size(), 1u);
  EXPECT_EQ(rim.ranges[0].measure, "radius");
  const ExpressionBoxes boxes{.object = {.sides = {40, 5, 3}}, .worksets = {.sides = {4, 3, 2}}};
  EXPECT_EQ(rim.ranges[0].low->evaluate(boxes), 1);
  EXPECT_EQ(rim.ranges[0].high->evaluate(boxes), 40);
  EXPECT_EQ(rim.max_fit_error->evaluate(boxes), 2);
  EXPECT_EQ(model.features[1].worksets, (std::vector<std::string>{"convex", "concave"}));
  EXPECT_EQ(model.features[1].shape.arguments,
            (std::vector<std::pair<std::string, std::string>>{{"segments", "3"}, {"closed", "true"}}));
  EXPECT_EQ(model.features[2].detectability, 1);
  EXPECT_FALSE(model.features[2].max_fit_error);

  ASSERT_EQ(model.relationships.size(), 2u);
  EXPECT_EQ(model.relationships[1].plugin, "centroid-distance");
  EXPECT_EQ(model.relationships[1].features, (std::vector<Index>{1, 2}));
  ASSERT_EQ(model.relationships[1].arguments.size(), 1u);
  EXPECT_EQ(model.relationships[1].arguments[0].second.evaluate(boxes), 0.75);
  ASSERT_EQ(model.classes.size(), 2u);
  EXPECT_EQ(model.classes[1].relationships, (std::vector<Index>{0, 1}));
}

TEST_F(ReadModel, NeedsNoAbstractPartNorCatalog) {
  const std::string text =
      "schema: toposcope.model/1\nname: x\nfeatures:\n  f: {worksets: [a], shape: nobody-knows, ranges: {m: 0 < m}}\n";
  const Model model = model_from_text(text, "m.yaml", nullptr);
  EXPECT_TRUE(model.abstract.objects.empty());
  EXPECT_EQ(model.features[0].realises, "");
  EXPECT_THAT(error_of(text), AllOf(HasSubstr("m.yaml:4:18: no working-set plugin provides the type 'a'"),
                                    HasSubstr("m.yaml:4:29: there is no shape 'nobody-knows'")));
}

TEST_F(ReadModel, TakesTheShortFormOfLineGroups) {
  for (const char* shape : {"shape: lgrp3", "shape: {plugin: lgrp3}", "shape: {plugin: line-group, segments: 3}"}) {
    std::string text = sound;
    text.replace(text.find("shape: plane"), 12, shape);
    const Model model = model_from_text(text, "m.yaml", &catalog_);
    EXPECT_EQ(model.features[2].shape.plugin, "line-group") << shape;
    EXPECT_EQ(model.features[2].shape.arguments[0], (std::pair<std::string, std::string>{"segments", "3"})) << shape;
  }
  EXPECT_THAT(error_with("shape: plane", "shape: lgrp99"), HasSubstr("from 1 to 16"));
  EXPECT_THAT(error_with("shape: plane", "shape: {plugin: lgrp3, segments: 3}"), HasSubstr("given twice"));
}

TEST_F(ReadModel, TakesQuotedTextAndPointsIntoIt) {
  EXPECT_EQ(error_with("bb(w).c/2 < r < bb(O).a", "\"bb(w).c/2 < r < bb(O).a\""), "no error");
  EXPECT_THAT(error_with("bb(w).c/2 < r < bb(O).a", "'r < bb(O).z'"), StartsWith("m.yaml:23:26: "));
}

struct Change {
  const char* from;
  const char* to;
  const char* place;  ///< line:column
  const char* says;
};

TEST_F(ReadModel, SchemaErrorsNamePlaceValueAndRemedy) {
  const Change changes[] = {
      {"toposcope.model/1", "toposcope.model/2", "1:9",
       "'schema' is 'toposcope.model/2'; did you mean 'toposcope.model/1'?"},
      {"name: cup", "title: cup", "2:1", "unknown key 'title' in the document"},
      {"name: cup", "name: 12", "2:7", "'name' is 12; needed: the class"},
      {"name: cup", "name: my cup", "2:7", "'name' is 'my cup'"},
      {"cup: volume", "cup: solid", "4:8", "'objects.cup' is 'solid'; known are: point, line, surface, volume"},
      {"cup: volume", "cup: volum", "4:8", "did you mean 'volume'?"},
      {"  cup: volume", "  a cup: volume", "4:3", "'a cup' is not a name"},
      {"[wall, floor]", "wall", "11:9", "'topology.body' is 'wall'; needed: a list"},
      {"[wall, floor]", "[]", "11:9", "'topology.body' has 0 entries; needed: a list of one or more"},
      {"up: edgeLine", "above: edgeLine", "16:21", "unknown key 'above'"},
      {"{from: rimLine, ", "{", "16:5", "'associations.0' lacks 'from'"},
      {"worksets: [convex]\n", "workset: [convex]\n", "20:5",
       "unknown key 'workset' in 'features.rim'; did you mean 'worksets'?"},
      {"shape: circle", "shape: [circle]", "21:12", "'features.rim.shape' is a list; needed: the id of a shape"},
      {"{plugin: line-group, ", "{", "26:66", "'features.edge.shape' lacks 'plugin'"},
      {"detectability: 0.75", "detectability: 1.5", "25:20",
       "'features.rim.detectability' is 1.5; needed: the likelihood"},
      {"detectability: 0.75", "detectability: -0.1", "25:20", "from 0 to 1"},
      {"detectability: 0.75", "detectability: often", "25:20", "is 'often'"},
      {"detectability: 0.75", "detectability: .nan", "25:20", "is '.nan'"},
      {"detectability: 0.75", "detectability:", "25:5", "is empty"},
      {"[rim, edge]", "[]", "29:18", "'relationships.r1.features' has 0 entries; needed: a list of features"},
      {", type: concentric", "", "29:7", "'relationships.r1' lacks 'type'"},
  };
  for (const Change& change : changes) {
    const std::string error = error_with(change.from, change.to);
    EXPECT_THAT(error, HasSubstr(std::string("m.yaml:") + change.place + ": ")) << change.to;
    EXPECT_THAT(error, HasSubstr(change.says)) << change.to;
  }
}

TEST_F(ReadModel, YamlErrorsNameThePlace) {
  EXPECT_THAT(error_with("[wall, floor]", "[wall, floor"), HasSubstr(": not YAML: "));
  EXPECT_THAT(error_with("  body: volume", "  cup: volume"),
              StartsWith("m.yaml:5:3: 'cup' is given twice, first on line 4"));
  EXPECT_THAT(error_with("  r2:", "  r1:"), StartsWith("m.yaml:30:3: 'r1' is given twice, first on line 29"));
  EXPECT_THAT(error_with("  cup: volume", "  ? [a, b]\n  : volume"), StartsWith("m.yaml:4:5: a key must be"));
  EXPECT_THAT(error_of(""), StartsWith("m.yaml:1:1: "));
  EXPECT_THAT(error_of("just words"), AllOf(StartsWith("m.yaml:1:1: "), HasSubstr("is 'just words'")));
  EXPECT_THAT(error_of(sound + "---\n" + sound), HasSubstr("2 YAML documents"));
}

TEST_F(ReadModel, AliasesCannotBlowUp) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before;
    for (int k = 1; k < 10; ++k) bomb += ", " + before;
    bomb += "]\n";
  }
  EXPECT_THAT(error_of(bomb), HasSubstr("write out its aliases"));
  EXPECT_THAT(error_of("a: &a [*a]\n"), HasSubstr("write out its aliases"));
}

TEST_F(ReadModel, AbstractModelErrors) {
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

TEST_F(ReadModel, PointsHaveNoBoundary) {
  EXPECT_THAT(error_with("  edgeLine: line", "  edgeLine: line\n  tip: point\n  top: point") +
                  error_with("parts:", "  rimLine: [tip]\n  tip: [rimLine]\nparts:"),
              HasSubstr("there is no object 'tip'"));
  std::string text = sound;
  text.replace(text.find("  edgeLine: line"), 16, "  edgeLine: line\n  tip: point");
  text.replace(text.find("parts:"), 6, "  rimLine: [tip]\n  tip: [rimLine]\nparts:");
  EXPECT_EQ(error_of(text), "m.yaml:15:9: 'tip' (point) has no boundary: it is a point; remove the link");
}

TEST_F(ReadModel, WorkingModelErrors) {
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

TEST_F(ReadModel, ErrorsThatPluginsTell) {
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

TEST_F(ReadModel, EveryRelationshipMaySetItsTolerance) {
  std::string text = sound;
  text.replace(text.find("type: concentric"), 16, "type: concentric, tolerance: 40/2");
  const Model model = model_from_text(text, "m.yaml", &catalog_);
  ASSERT_TRUE(model.relationships[0].tolerance);
  EXPECT_EQ(model.relationships[0].tolerance->evaluate({}), 20);
  EXPECT_TRUE(model.relationships[0].arguments.empty()) << "it is no argument of the plugin";
  EXPECT_FALSE(model.relationships[1].tolerance);
}

TEST_F(ReadModel, TellsAllErrorsInTheOrderOfTheFile) {
  std::string text = sound;
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

TEST_F(ReadModel, AFileThatCannotBeReadIsNamed) {
  for (const char* file : {"no/such/model.yaml", TOPOSCOPE_SOURCE_DIR}) {
    try {
      read_model(file, nullptr);
      FAIL() << file;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(file), HasSubstr("cannot be read")));
    }
  }
}

}  // namespace
}  // namespace toposcope
