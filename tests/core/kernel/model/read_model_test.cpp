// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kernel/model/sound_model.h"

namespace toposcope {
namespace {

using test::Change;
using test::sound_model;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using ReadModel = test::ReadModel;

TEST_F(ReadModel, ReadsEveryPart) {
  ASSERT_TRUE(catalog_.problems().empty()) << catalog_.problems()[0].message;
  const Model model = model_from_text(sound_model, "m.yaml", &catalog_);
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
    std::string text = sound_model;
    text.replace(text.find("shape: plane"), 12, shape);
    text.replace(text.find("realises: floor"), 15, "realises: edgeLine");
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
      {"shape: circle", "shape: [circle]", "21:12", "'features.rim.shape' has 1 entries; needed: the id of a shape"},
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
  EXPECT_THAT(error_of(sound_model + "---\n" + sound_model), HasSubstr("several YAML documents"));
  EXPECT_THAT(error_of(",PX-"), HasSubstr("several YAML documents")) << "yaml-cpp makes documents of it without end";
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

TEST_F(ReadModel, MergeKeysGiveAFeatureWhatAnotherOneHas) {
  const std::string text =
      "schema: toposcope.model/1\nname: m\nfeatures:\n"
      "  one: &ring {worksets: [convex], shape: circle, ranges: {radius: 0 < r < bb(O).a}, detectability: 0.5}\n"
      "  two: {<<: *ring, detectability: 0.75}\n"
      "  three:\n    <<: [*ring, {max_fit_error: bb(O).a/20}]\n";
  const Model model = model_from_text(text, "m.yaml", nullptr);
  ASSERT_EQ(model.features.size(), 3U);
  EXPECT_EQ(model.features[1].shape.plugin, "circle");
  EXPECT_EQ(model.features[1].detectability, 0.75);
  EXPECT_EQ(model.features[1].ranges.size(), 1U);
  EXPECT_EQ(model.features[2].detectability, 0.5);
  EXPECT_TRUE(model.features[2].max_fit_error);
  EXPECT_FALSE(model.features[0].max_fit_error);
  const std::string bad =
      "schema: toposcope.model/1\nname: m\nfeatures:\n  one: {<<: 3, worksets: [convex], shape: circle}\n";
  EXPECT_THAT(error_of(bad), ::testing::HasSubstr("m.yaml:4:13: '<<' takes a mapping"));
}

TEST_F(ReadModel, AFeatureMayNameAlternativeShapes) {
  std::string text = sound_model;
  text.replace(text.find("shape: circle"), 13, "shape: [circle, {plugin: line-group, segments: 2}]");
  const Model model = model_from_text(text, "m.yaml", &catalog_);
  EXPECT_EQ(model.features[0].shape.plugin, "circle");
  ASSERT_EQ(model.features[0].other_shapes.size(), 1U);
  EXPECT_EQ(model.features[0].other_shapes[0].arguments[0].second, "2");
  EXPECT_THAT(error_with("shape: circle", "shape: [circle, circle]"), HasSubstr("names shape 'circle' twice"));
  EXPECT_THAT(error_with("shape: circle", "shape: [circle, cirkle]"), HasSubstr("did you mean 'circle'?"));
  EXPECT_THAT(error_with("shape: circle", "shape: [circle, plane]"), HasSubstr("by shape 'plane', which is a surface"));
  EXPECT_THAT(error_with("shape: circle", "shape: [circle]"), HasSubstr("has 1 entries"));
}

}  // namespace
}  // namespace toposcope
