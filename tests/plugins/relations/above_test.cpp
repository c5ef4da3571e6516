// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

const double diagonal = std::sqrt(16.0 + 9 + 4);  // of the fixture's object box

RelationResult above(const std::vector<Feature>& features, const Motion& motion = {}, const Settings& settings = {}) {
  const Arguments arguments(PluginKind::relations, "above", settings);
  std::vector<Feature> there;
  for (const Feature& feature : features) there.push_back(moved(feature, motion));
  std::vector<RelationOperand> operands;
  for (const Feature& feature : there) operands.push_back({&feature.shape, feature.points, {}});
  Box box;
  box.sides = {4 * motion.scale, 3 * motion.scale, 2 * motion.scale};
  return test::relation("above")->test({operands, box, 0.1 * motion.scale}, arguments.options(), context());
}
Feature at(const Vec3& center, const Vec3& normal = Vec3::UnitZ()) {
  return circle_feature(center, normal, 1);
}

TEST(Above, HeightIsMeasuredAlongTheThirdsAxis) {
  for (const double sign : {1.0, -1.0}) {  // the sign of a normal means nothing
    const Feature rim = at({5, 3, 2}, sign * Vec3::UnitZ());
    EXPECT_EQ(above({at({1, 0, 1}), at({-1, 2, 0}), rim}).residual, 0);
    EXPECT_NEAR(above({at({-1, 2, 0}), at({1, 0, 1}), rim}).residual, 1, 1e-12);
    EXPECT_NEAR(above({at({1, 0, 0}), at({1, 0, 0}), rim}).residual, 0, 1e-12);
  }
  // Upside down: the third below the second turns all.
  EXPECT_NEAR(above({at({1, 0, 1}), at({-1, 2, 0}), at({5, 3, -2})}).residual, 1, 1e-12);
}

TEST(Above, AThirdWithoutAxisOrAFourthGivesTheWay) {
  Feature ball = at({0, 4, 4});
  ball.shape.orientation = Orientation::none;
  EXPECT_NEAR(above({at({0, -1, 0}), at({0, 0, 0}), ball}).residual, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(above({at({0, 0, 1}), at({0, 0, 0}), ball}).residual, 0);
  const Feature low = at({9, 9, 9}), high = at({9, 10, 9});
  EXPECT_EQ(above({at({0, 1, 0}), at({0, 0, 5}), low, high}).residual, 0);
  EXPECT_NEAR(above({at({0, 1, 0}), at({0, 0, 5}), high, low}).residual, 1, 1e-12);
}

TEST(Above, TheModelMayAskForAHeight) {
  const std::vector<Feature> features = {at({0, 0, 1}), at({0, 0, 0}), at({0, 0, 2})};
  EXPECT_NEAR(above(features, {}, {{"min", "1.5"}}).residual, 0.5, 1e-12);
  EXPECT_EQ(above(features, {}, {{"min", "0.5"}}).residual, 0);
  EXPECT_NEAR(above(features, {}, {{"min", "0.5"}}).slack, diagonal - 0.5, 1e-12);
}

/// The height lies between minus and plus the diagonal.
TEST(Above, HoldingIsWorthOneBit) {
  const RelationResult result = above({at({0, 0, 1}), at({0, 0, 0}), at({0, 0, 2})});
  EXPECT_NEAR(result.slack * result.clutter_density, 0.5, 1e-12);
  EXPECT_NEAR(result.tolerance, 0.01 * diagonal, 1e-12);
  EXPECT_EQ(result.dof, 1);
}

TEST(Above, DeviationFollowsTheFits) {
  Feature upper = at({3, 0, 1}), lower = at({0, 0, 0}), top = at({0, 0, 2}), from = at({0, 0, 0});
  upper.shape.centroid_sd = 0.03, lower.shape.centroid_sd = 0.04;
  EXPECT_NEAR(above({upper, lower, top}).sd, 0.05, 1e-12);
  top.shape.direction_sd = 0.04;
  EXPECT_NEAR(above({upper, lower, top}).sd, std::hypot(0.05, 3 * 0.04), 1e-12);
  top.shape.centroid_sd = 0.08, from.shape.centroid_sd = 0.06;
  EXPECT_NEAR(above({upper, lower, from, top}).sd, std::hypot(0.05, 3 * 0.05), 1e-12);
}

TEST(Above, PoseAndScaleDoNotMatter) {
  Feature upper = at({3, 0, -1}), lower = at({0, 0, 0}), top = at({0, 2, 2}, {0.1, 0.2, 1}), from = at({1, 0, 0});
  upper.shape.centroid_sd = 0.03, top.shape.direction_sd = 0.04;
  for (const std::vector<Feature>& features :
       {std::vector<Feature>{upper, lower, top}, std::vector<Feature>{upper, lower, from, top}}) {
    const RelationResult here = above(features);
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const Motion motion = some_motion(seed);
      const RelationResult there = above(features, motion);
      EXPECT_NEAR(there.residual / motion.scale, here.residual, 1e-9);
      EXPECT_NEAR(there.tolerance / motion.scale, here.tolerance, 1e-9);
      EXPECT_NEAR(there.sd / motion.scale, here.sd, 1e-9);
      EXPECT_NEAR(there.clutter_density * motion.scale, here.clutter_density, 1e-9);
    }
  }
}

TEST(Above, WhereNothingIsUpItDoesNotApply) {
  const RelationResult level = above({at({0, 0, 1}), at({0, 0, 0}), at({7, 3, 0.001})});
  EXPECT_FALSE(level.applicable);
  EXPECT_NE(level.why.find("level"), std::string::npos);
  EXPECT_FALSE(above({at({0, 0, 1}), at({0, 0, 0}), at({1, 1, 1}), at({1, 1, 1})}).applicable);
}

}  // namespace
