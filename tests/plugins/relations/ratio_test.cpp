// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

Feature ring(double radius, double sd = 0) {
  Feature feature = circle_feature(Vec3::Zero(), Vec3::UnitZ(), radius);
  feature.shape.measures[0].sd = sd;
  return feature;
}

TEST(Ratio, LiesBetweenTheBounds) {
  const Settings bounds = {{"min", "1.5"}, {"max", "3"}};
  EXPECT_EQ(relate_all("ratio", {ring(4), ring(2)}, bounds).residual, 0);
  // Of a sum of 5 the ratio 1.5 gives the first 3, of one of 8 the ratio 3 gives it 6.
  EXPECT_NEAR(relate_all("ratio", {ring(2), ring(3)}, bounds).residual, 1, 1e-12);
  EXPECT_NEAR(relate_all("ratio", {ring(7), ring(1)}, bounds).residual, 1, 1e-12);
  EXPECT_EQ(relate_all("ratio", {ring(7), ring(1)}, {{"min", "1.5"}}).residual, 0) << "without an upper bound";
}

TEST(Ratio, TheSlackIsThePartOfTheSum) {
  const RelationResult result = relate_all("ratio", {ring(4), ring(4)}, {{"min", "1"}, {"max", "3"}});
  EXPECT_NEAR(result.slack, 6 - 4, 1e-12);
  EXPECT_NEAR(result.clutter_density, 1.0 / 8, 1e-12);
}

TEST(Ratio, DeviationIsThatAtTheNearerBound) {
  const RelationResult result = relate_all("ratio", {ring(2, 0.3), ring(3, 0.1)}, {{"min", "4"}, {"max", "9"}});
  EXPECT_NEAR(result.sd, std::hypot(0.3, 0.4) / 5, 1e-12);
}

/// The reported density, times the slack, is the part of unrelated pairs that hold: both sizes drawn evenly.
TEST(Ratio, DensityIsThatOfUnrelatedSizesOfOneSum) {
  const double sum = 10;
  int holding = 0;
  constexpr int count = 10000;
  for (int i = 0; i < count; ++i) {
    const double first = sum * (i + 0.5) / count;
    holding += relate_all("ratio", {ring(first), ring(sum - first)}, {{"min", "0.5"}, {"max", "2"}}).residual == 0;
  }
  const RelationResult result = relate_all("ratio", {ring(5), ring(5)}, {{"min", "0.5"}, {"max", "2"}});
  EXPECT_NEAR(result.slack * result.clutter_density, static_cast<double>(holding) / count, 1e-3);
}

TEST(Ratio, NeedsAMeasureInCommonAndBoundsInOrder) {
  EXPECT_FALSE(relate_all("ratio", {ring(2), segment_feature(Vec3::Zero(), Vec3::UnitX())}, {{"max", "2"}}).applicable);
  EXPECT_ANY_THROW(relate_all("ratio", {ring(2), ring(2)}, {{"min", "3"}, {"max", "2"}}));
}

TEST(Ratio, PoseAndScaleDoNotMatter) {
  expect_pose_does_not_matter(
      "ratio", {circle_feature({1, 2, 3}, Vec3::UnitZ(), 2), circle_feature({3, 2, 1}, Vec3::UnitX(), 3)},
      {{"min", "1"}, {"max", "2"}});
}

}  // namespace
