// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

Feature ring(double radius, double sd = 0) {
  Feature feature = circle_feature(Vec3::Zero(), Vec3::UnitZ(), radius);
  feature.shape.measures = {{"radius", radius, sd}, {"length", 10 / radius, 0}};
  return feature;
}

TEST(Larger, TheFirstIs) {
  EXPECT_EQ(relate_all("larger", {ring(3), ring(2)}).residual, 0);
  EXPECT_EQ(relate_all("larger", {ring(2), ring(2)}).residual, 0);
  // Of a sum of 5 the first would have to have 2.5.
  EXPECT_NEAR(relate_all("larger", {ring(2), ring(3)}).residual, 0.5, 1e-12);
  EXPECT_NEAR(relate_all("larger", {ring(2), ring(3)}).tolerance, 0.02 * 2.5, 1e-12);
}

TEST(Larger, ByAFactorThatTheModelGives) {
  EXPECT_EQ(relate_all("larger", {ring(4), ring(2)}, {{"times", "2"}}).residual, 0);
  EXPECT_NEAR(relate_all("larger", {ring(3), ring(3)}, {{"times", "2"}}).residual, 1, 1e-12) << "4 and 2 of 6";
}

TEST(Larger, ByAMeasureThatTheModelNames) {
  EXPECT_GT(relate_all("larger", {ring(3), ring(2)}, {{"measure", "length"}}).residual, 0);
  EXPECT_EQ(relate_all("larger", {ring(2), ring(3)}, {{"measure", "length"}}).residual, 0);
  EXPECT_FALSE(relate_all("larger", {ring(2), ring(3)}, {{"measure", "extent"}}).applicable);
  EXPECT_FALSE(relate_all("larger", {ring(2), segment_feature(Vec3::Zero(), Vec3::UnitX())}).applicable);
}

/// Of two unrelated sizes either is as often the larger one.
TEST(Larger, HoldingIsWorthOneBit) {
  const RelationResult result = relate_all("larger", {ring(3), ring(2)});
  EXPECT_NEAR(result.slack * result.clutter_density, 0.5, 1e-12);
  EXPECT_EQ(result.dof, 1);
}

TEST(Larger, DeviationsOfBothCount) {
  EXPECT_NEAR(relate_all("larger", {ring(2, 0.3), ring(2, 0.4)}).sd, 0.25, 1e-12);
}

TEST(Larger, PoseAndScaleDoNotMatter) {
  expect_pose_does_not_matter(
      "larger", {circle_feature({1, 2, 3}, Vec3::UnitZ(), 2), circle_feature({3, 2, 1}, Vec3::UnitX(), 3)});
}

}  // namespace
