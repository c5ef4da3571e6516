// SPDX-License-Identifier: BSD-3-Clause
#include "learn/learn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "core/kernel/model/sound_model.h"

namespace toposcope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(WithLessons, SetsValuesWhereverTheyStandAndLeavesTheRest) {
  const std::string text = R"(# A comment.
name: m
features:
  rim:  # the upper edge
    worksets: [convex]
    ranges:
      radius: bb(w).c/2 < r < bb(O).a  # as tables say
      length: "0 < l"
    detectability: 0.75
  edge: {worksets: [convex], shape: circle}
relationships:
  r1: {features: [rim, edge], type: concentric, tolerance: 5}
  r2:
    features: [rim, edge]
    type: parallel
)";
  const std::string written = with_lessons(text, "m.yaml",
                                           {{{"features", "rim", "ranges", "radius"}, "0.1*bb(O).a < radius", ""},
                                            {{"features", "rim", "ranges", "length"}, "1 < length", ""},
                                            {{"features", "rim", "detectability"}, "0.8", ""},
                                            {{"features", "edge", "detectability"}, "0.6", ""},
                                            {{"relationships", "r1", "tolerance"}, "7", ""},
                                            {{"relationships", "r2", "tolerance"}, "9", ""}},
                                           "learned");
  EXPECT_EQ(written, R"(# A comment.
name: m
features:
  rim:  # the upper edge
    worksets: [convex]
    ranges:
      radius: 0.1*bb(O).a < radius  # as tables say; learned
      length: 1 < length  # learned
    detectability: 0.8  # learned
  edge: {detectability: 0.6, worksets: [convex], shape: circle}  # learned
relationships:
  r1: {features: [rim, edge], type: concentric, tolerance: 7}  # learned
  r2:
    tolerance: 9  # learned
    features: [rim, edge]
    type: parallel
)");
  EXPECT_EQ(with_lessons(text, "m.yaml", {}, "learned"), text);
}

class Learning : public test::ReadModel {
 protected:
  /// The sound model: rim (radius), edge, bottom; r1 and r2.
  Learning() : model_(model_from_text(test::sound_model, "m.yaml", &catalog_)) {}

  static Observation seen(double radius, bool offered, double residual) {
    Observation observation{"a.truth.json", std::vector<SeenFeature>(3), std::vector<SeenRelation>(2)};
    SeenFeature& rim = observation.features[0];
    rim.marked = rim.exists = true;
    rim.offered = offered;
    rim.measures["radius"] = {radius, 2 * radius, 3 * radius};
    observation.relations[0] = {true, true, residual <= 0.02, residual, 0.02, "length"};
    return observation;
  }

  const Lesson* lesson(const Learned& learned, const std::string& last) const {
    for (const Lesson& each : learned.lessons)
      if (each.path.back() == last) return &each;
    return nullptr;
  }

  Model model_;
};

TEST_F(Learning, RangesKeepTheirSidesAndHoldWhatWasSeen) {
  const Learned learned = learn(model_, {seen(0.3, true, 0), seen(0.33, true, 0), seen(0.31, true, 0)}, 0.99);
  ASSERT_TRUE(lesson(learned, "radius"));
  const Lesson& radius = *lesson(learned, "radius");
  EXPECT_THAT(radius.path, ElementsAre("features", "rim", "ranges", "radius"));
  EXPECT_EQ(radius.before, "bb(w).c/2 < radius < bb(O).a");
  const ParsedRange range = parse_range(radius.value, {"m.yaml", 1, 1}, 1);
  const ExpressionBoxes boxes{.object = {.sides = {1, 1, 1}}, .worksets = {}};
  EXPECT_LT(range.low->evaluate(boxes), 0.25);
  EXPECT_GT(range.low->evaluate(boxes), 0.1);
  EXPECT_GT(range.high->evaluate(boxes), 0.38);
  EXPECT_LT(range.high->evaluate(boxes), 0.94);
  EXPECT_EQ(lesson(learned, "detectability")->value, "0.8");
  EXPECT_EQ(learned.contradictions, std::vector<std::string>{});
}

TEST_F(Learning, WhatTheMarksContradictIsSaid) {
  Observation broken = seen(0.3, false, 0.05);
  broken.features[0].broken = {"radius < bb(O).a = 1, and the marks have 1.2"};
  const Learned learned = learn(model_, {broken, seen(0.3, false, 0.01)}, 0.95);
  EXPECT_THAT(learned.contradictions,
              ElementsAre("a.truth.json: 'rim' breaks radius < bb(O).a = 1, and the marks have 1.2",
                          "a.truth.json: 'rim' is marked, and no candidate is there; see toposcope model probe",
                          HasSubstr("r1 concentric does not hold: residual 0.05, tolerance 0.02 of bb(O).a")));
  EXPECT_EQ(lesson(learned, "detectability")->value, "0.25") << "found on none of two";
  ASSERT_TRUE(lesson(learned, "tolerance"));
  EXPECT_THAT(lesson(learned, "tolerance")->value, HasSubstr("*bb(O).a"));
}

TEST_F(Learning, WhatHoldsBetterThanItMustIsLeft) {
  EXPECT_FALSE(lesson(learn(model_, {seen(0.3, true, 0.001), seen(0.3, true, 0)}, 0.99), "tolerance"));
}

}  // namespace
}  // namespace toposcope
