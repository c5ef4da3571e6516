// SPDX-License-Identifier: BSD-3-Clause
// The models that the project ships, checked against its own plugins and held against the dissertation's tables.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "model/networks.h"
#include "model/read_model.h"
#include "model/show_model.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

const fs::path models = fs::path(TOPOSCOPE_SOURCE_DIR) / "models";

std::vector<fs::path> shipped() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(models))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Model read(const std::string& name) {
  return read_model(models / (name + ".yaml"), &test::host().catalog());
}

/// "r1 concentric rim bottomEdge"
std::vector<std::string> relations_of(const Model& model) {
  std::vector<std::string> lines;
  for (const Relationship& relationship : model.relationships) {
    std::string line = relationship.name + " " + relationship.plugin;
    for (const Index f : relationship.features) line += " " + model.features[f].name;
    for (const auto& [name, value] : relationship.arguments) line += " " + name + "=" + value.text();
    lines.push_back(line);
  }
  return lines;
}

TEST(ShippedModels, CupIsThatOfTable51) {
  const Model cup = read("neal-1999/cup");
  std::map<std::string, double> detectability;
  for (const ModelFeature& feature : cup.features) detectability[feature.name] = feature.detectability;
  EXPECT_EQ(detectability,
            (std::map<std::string, double>{{"rim", 1.0}, {"bottomEdge", 0.9}, {"bottom", 1.0}, {"handleCon", 0.5}}));
  EXPECT_THAT(relations_of(cup),
              ElementsAre("r1 concentric rim bottomEdge", "r2 centroid-distance bottomEdge bottom min=0 max=bb(O).c/4",
                          "r3 perpendicular handleCon rim", "r4 perpendicular handleCon bottomEdge"));
  const ExpressionBoxes boxes{.object = {.sides = {16, 8, 4}}, .worksets = {.sides = {6, 5, 3}}};
  for (const Index circle : {0u, 1u}) {
    EXPECT_EQ(cup.features[circle].ranges[0].low->evaluate(boxes), 1.5);
    EXPECT_EQ(cup.features[circle].ranges[0].high->evaluate(boxes), 16);
  }
  EXPECT_TRUE(cup.features[2].ranges.empty());
  EXPECT_EQ(cup.features[3].worksets, (std::vector<std::string>{"concave", "concave"}));
  EXPECT_EQ(cup.features[3].ranges[0].low->evaluate(boxes), 4);
  EXPECT_EQ(cup.features[3].ranges[0].high->evaluate(boxes), 16);
}

TEST(ShippedModels, AirplaneIsThatOfTables52And53) {
  const Model airplane = read("neal-1999/airplane");
  ASSERT_EQ(airplane.features.size(), 5u);
  const double detectabilities[] = {1.0, 1.0, 0.8, 0.8, 0.5};
  const ExpressionBoxes boxes{.object = {.sides = {16, 8, 4}}, .worksets = {.sides = {6, 5, 3}}};
  for (std::size_t f = 0; f < 5; ++f) {
    const ModelFeature& feature = airplane.features[f];
    EXPECT_EQ(feature.detectability, detectabilities[f]);
    EXPECT_EQ(feature.shape.plugin, "line-group");
    ASSERT_EQ(feature.ranges.size(), 3u);
    const double highest[] = {6, 5, 6};
    for (std::size_t segment = 0; segment < 3; ++segment) {
      EXPECT_EQ(feature.ranges[segment].measure, "length_" + std::to_string(segment + 1));
      EXPECT_EQ(feature.ranges[segment].low->evaluate(boxes), 0);
      EXPECT_EQ(feature.ranges[segment].high->evaluate(boxes), highest[segment]);
    }
  }
  EXPECT_THAT(relations_of(airplane),
              ElementsAre("r1 reflective-symmetry pWingE sWingE", "r2 parallel pWingE sWingE",
                          "r3 centroid-distance pWingE sWingE min=bb(O).b/4 max=bb(O).b",
                          "r4 reflective-symmetry pHzStabE sHzStabE", "r5 perpendicular pHzStabE vStabE",
                          "r6 perpendicular sHzStabE vStabE", "r7 centroid-distance pHzStabE vStabE min=0 max=bb(O).c",
                          "r8 centroid-distance sHzStabE vStabE min=0 max=bb(O).c"));
}

TEST(ShippedModels, PipeFittingIsThatOfTable62) {
  const Model fitting = read("neal-1999/pipe-fitting");
  ASSERT_EQ(fitting.features.size(), 4u);
  EXPECT_THAT(relations_of(fitting), ElementsAre("r1 concentric rim1 rim2", "r2 perpendicular rim1 rim2",
                                                 "r3 centroid-distance rim1 rim3 min=0 max=bb(O).a/2",
                                                 "r4 perpendicular rim1 rim3", "r5 concentric rim3 rim4"));
  std::map<std::string, std::vector<Index>> rules;
  for (const ClassRule& rule : fitting.classes) rules[rule.name] = rule.relationships;
  EXPECT_EQ(rules, (std::map<std::string, std::vector<Index>>{
                       {"wye", {0, 2}}, {"cross", {0, 3, 4}}, {"elbow", {1}}, {"tricorner", {1, 3}}, {"tee", {0, 3}}}));
}

TEST(ShippedModels, TheCupOfFigure32) {
  const AbstractModel cup = read("neal-1999/cup").abstract;
  EXPECT_EQ(cup.objects[cup.root].name, "cup");
  std::map<std::string, std::vector<std::string>> told;
  for (Index object = 0; object < cup.objects.size(); ++object)
    for (const Link& link : links_from(cup, object))
      told[cup.objects[object].name + " " + link.kind].push_back(cup.objects[link.to].name);
  EXPECT_THAT(told["cup has-part"], ElementsAre("body", "handle"));
  EXPECT_EQ(told.count("cup part-of"), 0u);
  EXPECT_THAT(told["handle part-of"], ElementsAre("cup"));
  EXPECT_THAT(told["body bounded-by"], ElementsAre("insideSurface", "outsideSurface", "bottomSurface"));
  EXPECT_THAT(told["handleSurface boundary-of"], ElementsAre("handle"));
  EXPECT_THAT(told["rim boundary-of"], ElementsAre("insideSurface", "outsideSurface"));
  EXPECT_EQ(told.count("rim bounded-by"), 0u) << "circular: no boundary";
}

TEST(ShippedModels, AllAreSoundAndCanBeShown) {
  ASSERT_GE(shipped().size(), 7u);
  for (const fs::path& file : shipped()) {
    SCOPED_TRACE(file);
    const Model model = read_model(file, &test::host().catalog());
    EXPECT_EQ(model.name, file.stem());
    EXPECT_FALSE(model.summary.empty());
    const std::string text = model_as_text(model);
    const auto shows = [&](const std::string& part) { return text.find(part) != std::string::npos; };
    for (const ModelFeature& feature : model.features) EXPECT_TRUE(shows("\n  " + feature.name + " ")) << feature.name;
    for (const SpatialObject& object : model.abstract.objects)
      EXPECT_TRUE(shows("\n  " + object.name + " ")) << object.name;
    for (const Relationship& relationship : model.relationships) {
      EXPECT_TRUE(shows("\n  " + relationship.name + " ")) << relationship.name;
      EXPECT_TRUE(shows(" " + relationship.plugin + "(" + model.features[relationship.features[0]].name +
                        (relationship.features.size() > 1 ? ", " : ")")))
          << relationship.name;
    }
  }
}

}  // namespace
}  // namespace toposcope
