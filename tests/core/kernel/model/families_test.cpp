// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kernel/model/sound_model.h"
#include "model/show_model.h"

namespace toposcope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string table = R"(schema: toposcope.model/1
name: table
features:
  top: {worksets: [planar], shape: plane, required: true}
  leg: {worksets: [convex], shape: circle, count: 3..8}
  foot: {worksets: [convex], shape: circle, count: 0..1}
relationships:
  r1: {features: [leg, top], type: perpendicular}
  r2: {features: [leg, leg], type: parallel}
  r3: {features: [foot, top], type: parallel}
measures:
  size: top.extent
)";

class FamilyModels : public test::ReadModel {
 protected:
  std::string error_with(const std::string& from, const std::string& to) const {
    std::string text = table;
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return error_of(text.replace(place, from.size(), to));
  }
  Model with_count(const std::string& count) const {
    std::string text = table;
    return model_from_text(text.replace(text.find("3..8"), 4, count), "m.yaml", &catalog_);
  }
};

TEST_F(FamilyModels, ANumberARangeOrAnyNumber) {
  const struct {
    const char* text;
    Index least;
    std::optional<Index> most;
    const char* words;
  } counts[] = {{"3..8", 3, 8, "instances: 3 to 8"},
                {"4", 4, 4, "instances: 4"},
                {"0..", 0, std::nullopt, "instances: any number"},
                {"2..", 2, std::nullopt, "instances: at least 2"},
                {"'0..2'", 0, 2, "instances: 0 to 2"}};
  for (const auto& each : counts) {
    const Model model = with_count(each.text);
    const InstanceCount& count = model.features[1].count;
    EXPECT_EQ(count.least, each.least) << each.text;
    EXPECT_EQ(count.most, each.most) << each.text;
    EXPECT_TRUE(count.family()) << each.text;
    EXPECT_THAT(model_as_text(model), HasSubstr(each.words));
  }
}

TEST_F(FamilyModels, OneThatMustBeThereAndOneThatMay) {
  const Model model = with_count("2");
  EXPECT_TRUE(model.features[0].required() && !model.features[0].count.family());
  EXPECT_FALSE(model.features[2].required() || model.features[2].count.family());
  EXPECT_THAT(model_as_text(model), HasSubstr("top   plane on planar, detectability 1, required\n"));
  EXPECT_EQ(model.relationships[1].features, (std::vector<Index>{1, 1}));
}

TEST_F(FamilyModels, CountsThatAreNone) {
  const struct {
    const char *count, *place, *says;
  } wrong[] = {
      {"8..3", "5:51", "count '8..3' is empty, 8 is more than 3; write 3..8"},
      {"0", "5:51", "count '0' allows no instance; remove the feature, or write 0.. for any number"},
      {"0..0", "5:51", "allows no instance"},
      {"many", "5:51", "count 'many' is neither a number nor a range of numbers up to 1000; write 4, 3..8, or 0.."},
      {"-1", "5:51", "is neither"},
      {"3...8", "5:51", "is neither"},
      {"..8", "5:51", "is neither"},
      {"1..99999999999", "5:51", "is neither"},
      {"3.5", "5:51", "3.5"},
  };
  for (const auto& each : wrong) {
    const std::string error = error_with("3..8", each.count);
    EXPECT_THAT(error, StartsWith(std::string("m.yaml:") + each.place + ": ")) << each.count;
    EXPECT_THAT(error, HasSubstr(each.says));
  }
}

TEST_F(FamilyModels, WhatFamiliesCannotBeAsked) {
  const struct {
    const char *from, *to, *place, *says;
  } wrong[] = {
      {"required: true}", "required: true, count: 1}", "4:53", "'required' and 'count' say the same thing"},
      {"[leg, leg]", "[top, top]", "9:24", "names feature 'top' twice, of which there is at most one"},
      {"[leg, leg], type: parallel", "[leg, leg, leg], type: angle", "9:29", "names family 'leg' more than twice"},
      {"count: 0..1", "count: 0..2}\n  pad: {worksets: [convex], shape: circle, count: 0..", "", ""},
      {"[foot, top]", "[foot, leg]", "", ""},
      {"count: 3..8", "second_look: [convex], count: 3..8", "5:57", "a second look is for one feature"},
      {"size: top.extent", "size: leg.radius", "12:9",
       "measure 'size' names family 'leg', of which there may be several; 'run --features FILE' writes"},
      {"measures:", "classes:\n  plain: [r1]\nmeasures:", "12:10",
       "class 'plain' asks for relationship 'r1' of family 'leg'; a class is told by features of which there is one"},
  };
  for (const auto& each : wrong) {
    const std::string error = error_with(each.from, each.to);
    if (*each.says == '\0') {
      EXPECT_EQ(error, "no error") << each.to;
      continue;
    }
    EXPECT_THAT(error, StartsWith(std::string("m.yaml:") + each.place + ": ")) << each.to;
    EXPECT_THAT(error, HasSubstr(each.says));
  }
  EXPECT_THAT(error_with("foot: {worksets: [convex], shape: circle, count: 0..1}\nrelationships:",
                         "foot: {worksets: [convex], shape: circle, count: 0..}\nrelationships:\n"
                         "  r0: {features: [leg, foot], type: parallel}"),
              StartsWith("m.yaml:8:24: relationship 'r0' names two families, 'leg' and 'foot'; name one"));
}

}  // namespace
}  // namespace toposcope
