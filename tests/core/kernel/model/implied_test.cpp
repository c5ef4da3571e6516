// SPDX-License-Identifier: BSD-3-Clause
// What relationships follow from an abstract part, and which abstract parts a working part refutes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "model/read_model.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

const std::string head = R"(schema: toposcope.model/1
name: tower
objects: {tower: volume, top: surface, middle: surface, base: surface, hull: surface, rim: line, foot: line}
topology: {tower: [hull], top: [rim]}
parts: {hull: [top, middle, base]}
)";
const std::string features = R"(features:
  top: {realises: top, worksets: [planar], shape: plane}
  middle: {realises: middle, worksets: [planar], shape: plane}
  base: {realises: base, worksets: [planar], shape: plane}
  rim: {realises: rim, worksets: [convex], shape: circle}
)";

std::string rooted(const std::string& associations) {  // `foot` must hang somewhere
  std::string text = head;
  return text.replace(text.find("top: [rim]"), 10, "top: [rim], base: [foot]") + associations + features;
}

Model read(const std::string& text) {
  return model_from_text(text, "tower.yaml", &test::host().catalog());
}

std::vector<std::string> implied(const std::string& text) {
  const Model model = read(text);
  std::vector<std::string> all;
  for (const Relationship& relationship : model.relationships) {
    if (relationship.because.empty()) continue;
    std::string line = relationship.name + " " + relationship.plugin;
    for (const Index f : relationship.features) line += " " + model.features[f].name;
    all.push_back(line);
  }
  return all;
}

std::string refused(const std::string& text) {
  try {
    read(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "none";
}

TEST(Implied, ALineTouchesTheSurfaceThatItBounds) {
  EXPECT_THAT(implied(rooted("")), ElementsAre("a1 adjacent rim top"));
}

TEST(Implied, AdjacentObjectsTouch) {
  EXPECT_THAT(implied(rooted("associations: [{from: top, adjacent-to: middle}, {from: base, adjacent-to: tower}]\n")),
              ElementsAre("a1 adjacent rim top", "a2 adjacent top middle"))
      << "nothing realises the tower";
}

TEST(Implied, ADirectionGivesAnOrder) {
  EXPECT_THAT(implied(rooted("associations: [{from: top, up: middle}, {from: base, down: middle}]\n")),
              ElementsAre("a1 adjacent rim top", "a2 between middle base top"));
  EXPECT_THAT(implied(rooted("associations: [{from: top, up: base}, {from: middle, up: base}]\n")),
              ElementsAre("a1 adjacent rim top", "a2 above top base middle"));
  EXPECT_THAT(implied(rooted("associations: [{from: top, front: foot}, {from: foot, front: base}]\n")),
              ElementsAre("a1 adjacent rim top"))
      << "of two alone nothing says which way is front";
  EXPECT_THAT(implied(rooted("associations: [{from: top, right: foot}, {from: foot, right: middle}, "
                             "{from: middle, right: base}]\n")),
              ElementsAre("a1 adjacent rim top", "a2 between middle base top"))
      << "through an object without a feature";
}

TEST(Implied, PartsLieInsideAndTwoPartsTouch) {
  const std::string text = R"(schema: toposcope.model/1
name: lamp
objects: {lamp: surface, shade: surface, stand: surface, foot: surface, shaft: surface}
parts: {lamp: [shade, stand], stand: [foot, shaft]}
features:
  shade: {realises: shade, worksets: [convex], shape: cone}
  stand: {realises: stand, worksets: [convex], shape: cylinder}
  foot: {realises: foot, worksets: [planar], shape: plane}
)";
  EXPECT_THAT(implied(text), ElementsAre("a1 inside foot stand", "a2 adjacent shade stand"));
}

TEST(Implied, TheWriterMaySayOtherwise) {
  const std::string text =
      rooted("associations: [{from: top, adjacent-to: middle}, {from: middle, adjacent-to: base}]\n");
  const std::string written = text + R"(relationships:
  r1: {features: [middle, top], type: centroid-distance, min: 0, max: bb(O).a}
  r2: {features: [middle, base], type: parallel}
  a1: {features: [top, base], type: parallel}
)";
  EXPECT_THAT(implied(written), ElementsAre("a2 adjacent rim top", "a3 adjacent middle base"))
      << "an angle says nothing of places; a name that is taken is not given again";
  const Model model = read(written);
  ASSERT_EQ(model.overruled.size(), 1u);
  EXPECT_EQ(model.overruled[0].by, "r1");
  EXPECT_EQ(model.overruled[0].because, "top adjacent-to middle, line 6");
  EXPECT_THAT(implied(text + "implied: false\n"), IsEmpty());
  EXPECT_THAT(implied(text + "implied: true\n"),
              ElementsAre("a1 adjacent rim top", "a2 adjacent top middle", "a3 adjacent middle base"));
  EXPECT_THAT(implied(text + "implied: [bounded-by, up]\n"), ElementsAre("a1 adjacent rim top"));
  EXPECT_THAT(refused(text + "implied: [above]\n"), HasSubstr("tower.yaml:12:11"));
  EXPECT_THAT(refused(text + "implied: sometimes\n"), HasSubstr("implied"));
}

TEST(Implied, AClassHasWhatFollowsOfItsFeatures) {
  const Model model = read(rooted("associations: [{from: top, adjacent-to: middle}]\n") + R"(relationships:
  r1: {features: [middle, base], type: parallel}
  r2: {features: [middle, top], type: parallel}
classes: {low: [r1], high: [r1, r2]}
)");
  ASSERT_EQ(model.relationships.size(), 4u);
  EXPECT_THAT(model.classes[0].relationships, ElementsAre(0));
  EXPECT_THAT(model.classes[1].relationships, ElementsAre(0, 1, 3)) << "the rim is in neither";
}

TEST(Implied, AnOrderAgainstTheAssociationsIsRefused) {
  const std::string order = "associations: [{from: top, up: middle}, {from: middle, up: base}]\n";
  const auto with = [&](const std::string& relationship) {
    return refused(rooted(order) + "relationships:\n  r1: " + relationship + "\n");
  };
  EXPECT_EQ(with("{features: [top, base, middle], type: above}"), "none");
  EXPECT_EQ(with("{features: [middle, base, top], type: between}"), "none");
  EXPECT_EQ(with("{features: [base, middle, rim], type: above}"), "none") << "nothing says where the rim lies";
  EXPECT_THAT(with("{features: [base, middle, top], type: above}"),
              AllOf(HasSubstr("tower.yaml:13:3: relationship 'r1' (above) puts 'base' up of 'middle'"),
                    HasSubstr("lies down of it"), HasSubstr("change the relationship or the associations")));
  EXPECT_THAT(with("{features: [top, base, middle, rim], type: above}"), "none");
  EXPECT_THAT(with("{features: [top, middle, base], type: between}"), HasSubstr("'top'"));
}

TEST(Implied, AxesNameFeatures) {
  const Model model = read(rooted("") + "axes: {up: [top, base]}\n");
  ASSERT_EQ(model.axes.size(), 1u);
  EXPECT_THAT(model.axes[0].features, ElementsAre(0, 2));
  EXPECT_THAT(refused(rooted("") + "axes: {up: [tip]}\n"),
              AllOf(HasSubstr("tower.yaml:11:13"), HasSubstr("'tip'"), HasSubstr("'top'?")));
  EXPECT_THAT(refused(rooted("") + "axes: {sideways: [top]}\n"), HasSubstr("tower.yaml:11:8"));
}

}  // namespace
}  // namespace toposcope
