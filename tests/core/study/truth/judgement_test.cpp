// SPDX-License-Identifier: BSD-3-Clause
#include "truth/judgement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/stations.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

/// Results made by hand, so that every distance is known.
class Judging : public ::testing::Test {
 protected:
  Judging() {
    result_.mean_edge = 0.1;
    result_.box.sides = {3, 4, 12};  // diagonal 13
    analysis_.classes.resize(1);
  }

  void add_feature(const std::string& name, const std::string& shape, bool present) {
    ModelFeature& feature = model_.features.emplace_back();
    feature.name = name;
    feature.shape.plugin = shape;
    FeatureStation& station = stations_.features.emplace_back();
    station.fitter = test::shape(shape);
    station.plugin = shape;
    analysis_.classes[0].features.push_back(static_cast<Index>(model_.features.size() - 1));
    FeatureReport& report = result_.features.emplace_back();
    report.name = name;
    report.shape_plugin = shape;
    report.present = present;
    report.probability = 0.75;
  }

  /// A circle of radius r about the z axis at height h.
  void add_circle(const std::string& name, double r, double h) {
    add_feature(name, "circle", true);
    result_.features.back().shape.parameters = {{"center", 3, {0, 0, h}}, {"normal", 3, {0, 0, 1}}, {"radius", 1, {r}}};
  }

  void add_segment(const std::string& name, const Vec3& a, const Vec3& b) {
    add_feature(name, "line-group", true);
    FittedShape& shape = result_.features.back().shape;
    shape.parameters = {{"endpoints", 3, {a.x(), a.y(), a.z(), b.x(), b.y(), b.z()}}};
    for (int i = 0; i <= 20; ++i) shape.outline.push_back(a + (b - a) * (i / 20.0));
  }

  static std::vector<Vec3> ring(double r, double h) {
    std::vector<Vec3> points;
    for (int i = 0; i < 16; ++i) points.emplace_back(r * std::cos(i * pi / 8), r * std::sin(i * pi / 8), h);
    return points;
  }

  static TruthFeature marked(const std::string& name, const std::vector<Vec3>& points) {
    TruthFeature feature;
    feature.name = name;
    feature.points = points;
    return feature;
  }

  /// Rings of a single mark around either end.
  static TruthFeature ended(const std::string& name, const Vec3& a, const Vec3& b) {
    TruthFeature feature = marked(name, {a, b});
    feature.groups = {{"", {0}, a}, {"", {1}, b}};
    return feature;
  }

  FeatureJudgement only(const TruthFeature& feature) {
    Truth truth;
    truth.features = {feature};
    return judge(result_, analysis_, model_, stations_, truth).features.at(0);
  }

  Model model_;
  Stations stations_;
  Result result_;
  Analysis analysis_;
};

TEST_F(Judging, ACircleWithinTwoMeanEdgesOfItsMarks) {
  add_circle("rim", 1, 5);
  FeatureJudgement judged = only(marked("rim", ring(1, 5.19)));
  EXPECT_NEAR(judged.distance, 0.19, 1e-9);
  EXPECT_NEAR(judged.excess, 0.95, 1e-9);
  EXPECT_EQ(judged.verdict, Verdict::right);
  EXPECT_EQ(judged.probability, 0.75);
  EXPECT_EQ(only(marked("rim", ring(1, 5.21))).verdict, Verdict::wrong);
  EXPECT_EQ(only(marked("rim", {})).verdict, Verdict::spurious);
}

TEST_F(Judging, ACircleAnywhereInItsBand) {
  add_circle("rim", 1.2, 5);
  TruthFeature in_band = marked("rim", ring(1.5, 5));
  in_band.parameters = {{"center", {0, 0, 5}}, {"normal", {0, 0, 1}}, {"band", {1.5, 1}}};
  EXPECT_EQ(only(marked("rim", ring(1.5, 5))).verdict, Verdict::wrong);
  EXPECT_NEAR(only(in_band).distance, 0, 1e-9);
  for (ShapeParameter& parameter : result_.features[0].shape.parameters)
    if (parameter.name == "radius") parameter.values = {1.7};
  EXPECT_NEAR(only(in_band).distance, 0.2, 1e-9) << "beyond the band its edge counts";
}

TEST_F(Judging, EndsNearTheirGroupsInEitherOrder) {
  add_segment("handleCon", {0, 0, 0}, {0, 0, 4});
  FeatureJudgement judged = only(ended("handleCon", {0, 0, 4.6}, {0, 0.3, 0}));
  EXPECT_NEAR(judged.distance, 0.6, 1e-9) << "the farther end";
  EXPECT_NEAR(judged.excess, 0.6 / (0.05 * 13), 1e-9);
  EXPECT_EQ(judged.verdict, Verdict::right);
  EXPECT_EQ(only(ended("handleCon", {0, 0, 4.7}, {0, 0, 0})).verdict, Verdict::wrong);
}

TEST_F(Judging, ALineGroupMustCoverItsMarksAndNothingElse) {
  add_segment("edge", {0, 0, 0}, {0, 0, 4});
  std::vector<Vec3> all, half;
  for (int i = 0; i <= 20; ++i) (i <= 10 ? half : all).emplace_back(0, 0, 0.2 * i);
  all.insert(all.end(), half.begin(), half.end());
  EXPECT_EQ(only(marked("edge", all)).verdict, Verdict::right);
  const FeatureJudgement judged = only(marked("edge", half));
  EXPECT_NEAR(judged.distance, 0, 1e-12) << "all marks are on it";
  EXPECT_NEAR(judged.excess * 0.03 * 13, 11.0 / 21, 1e-9)
      << "but it goes on to where none are: 0.2 (1 + ... + 10) / 21";
  EXPECT_EQ(judged.verdict, Verdict::wrong);
}

TEST_F(Judging, MissingFeatures) {
  add_feature("rim", "circle", false);
  EXPECT_EQ(only(marked("rim", {})).verdict, Verdict::absent);
  EXPECT_EQ(only(marked("rim", ring(1, 5))).verdict, Verdict::missed);
}

TEST_F(Judging, NamesThatTheModelCannotTellApartChangePlacesTogether) {
  add_circle("left1", 1, 0);
  add_circle("right1", 1, 5);
  add_circle("left2", 1, 1);
  add_circle("right2", 1, 6);
  Truth truth;
  truth.features = {marked("left1", ring(1, 5)), marked("right1", ring(1, 0)), marked("left2", ring(1, 6)),
                    marked("right2", ring(1, 1))};
  const auto relate = [&](Index a, Index b, const char* plugin) {
    Relationship& relationship = model_.relationships.emplace_back();
    relationship.plugin = plugin;
    relationship.features = {a, b};
    analysis_.classes[0].relationships.push_back(static_cast<Index>(model_.relationships.size() - 1));
    stations_.relationships.emplace_back();
  };
  relate(0, 1, "reflective-symmetry");
  relate(2, 3, "concentric");
  relate(0, 2, "nearer");
  relate(1, 3, "nearer");
  EXPECT_EQ(judge(result_, analysis_, model_, stations_, truth).right(), 4U) << "left and right change places";
  std::swap(truth.features[0].points, truth.features[1].points);
  EXPECT_EQ(judge(result_, analysis_, model_, stations_, truth).right(), 2U)
      << "one pair alone may not: the model ties the sides together";
}

}  // namespace
}  // namespace toposcope
