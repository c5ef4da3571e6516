// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

/// `count` small circles on a circle of `radius` about (1, 2, 3), the first at `phase`, in an order that is not theirs.
std::vector<Feature> holes(int count, double radius, double phase = 0.3) {
  const Vec3 n = Vec3(1, 2, -1).normalized(), u = any_perpendicular(n), v = n.cross(u);
  std::vector<Feature> all;
  for (int i = 0; i < count; ++i) {
    const double angle = phase + 2 * pi * ((i * 7) % count) / count;
    all.push_back(circle_feature(Vec3(1, 2, 3) + radius * (std::cos(angle) * u + std::sin(angle) * v), n, 0.1));
  }
  return all;
}

TEST(Ring, RegularPolygonsAreRings) {
  for (const int count : {3, 4, 5, 6, 8, 12, 60}) {
    const RelationResult result = relate_all("ring", holes(count, 2));
    ASSERT_TRUE(result.applicable) << result.why;
    EXPECT_NEAR(result.residual, 0, 1e-9) << count;
    EXPECT_NEAR(result.tolerance, 0.06, 1e-9) << "of the radius, which is that of the circle";
  }
}

TEST(Ring, TheResidualIsTheRootMeanSquareWayToThePlaces) {
  // One of n holes moved by d: the polygon follows by its seven numbers, so the rest is below d / sqrt(n).
  std::vector<Feature> moved = holes(12, 2);
  moved[3].shape.centroid += Vec3(1, 2, -1).normalized() * 0.2;
  const double out_of_plane = relate_all("ring", moved).residual;
  EXPECT_LT(out_of_plane, 0.2 / std::sqrt(12.0));
  EXPECT_GT(out_of_plane, 0.2 / std::sqrt(12.0) * std::sqrt(8.0 / 12));
  // All moved by the same motion: still a ring.
  for (Feature& each : moved = holes(5, 2)) each.shape.centroid += Vec3(3, 1, 1);
  EXPECT_NEAR(relate_all("ring", moved).residual, 0, 1e-9);
}

TEST(Ring, AGapIsNotEqualButOnACircle) {
  std::vector<Feature> five = holes(6, 2);
  five.pop_back();
  EXPECT_GT(relate_all("ring", five).residual, 0.1);
  EXPECT_NEAR(relate_all("ring", five, {{"equal", "false"}}).residual, 0, 1e-9);
}

TEST(Ring, TheModelMayBoundTheRadius) {
  EXPECT_NEAR(relate_all("ring", holes(6, 2), {{"max", "1.5"}}).residual, 0.5, 1e-9);
  EXPECT_NEAR(relate_all("ring", holes(6, 2), {{"min", "2.25"}}).residual, 0.25, 1e-9);
  EXPECT_NEAR(relate_all("ring", holes(6, 2), {{"min", "1"}, {"max", "3"}}).residual, 0, 1e-9);
}

/// Three points have a regular triangle but for two numbers; the density is that of a vector in their plane.
TEST(Ring, SaysWhatTheKernelNeeds) {
  std::vector<Feature> three = holes(3, 2);
  for (Feature& each : three) each.shape.centroid_sd = 0.3;
  const RelationResult result = relate_all("ring", three);
  const double range = std::sqrt(29.0) / std::sqrt(3.0);
  EXPECT_EQ(result.dof, 2);
  EXPECT_NEAR(result.sd, 0.3 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(result.clutter_density, 2 * pi / (range * range), 1e-12);
  EXPECT_EQ(relate_all("ring", holes(4, 2)).dof, 5);
  EXPECT_EQ(relate_all("ring", holes(60, 2)).dof, 6) << "many err together";
  EXPECT_TRUE(std::isfinite(relate_all("ring", holes(60, 2)).clutter_density));
}

TEST(Ring, ALineIsNone) {
  std::vector<Feature> line;
  for (int i = 0; i < 4; ++i) line.push_back(circle_feature({0.5 * i, 0, 0}, Vec3::UnitZ(), 0.1));
  EXPECT_FALSE(relate_all("ring", line).applicable);
}

TEST(Ring, PoseAndScaleDoNotMatter) {
  std::vector<Feature> uneven = holes(5, 2);
  uneven[2].shape.centroid += Vec3(0.2, -0.1, 0.1);
  expect_pose_does_not_matter("ring", uneven);
}

}  // namespace
