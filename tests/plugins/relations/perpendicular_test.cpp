// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

constexpr double degree = pi / 180;

Feature circle(const Vec3& normal) {
  return circle_feature(Vec3(1, 2, 3), normal, 1);
}
Feature segment(const Vec3& direction) {
  return segment_feature(Vec3(1, 0, 0), Vec3(Vec3(1, 0, 0) + direction));
}
Vec3 tilted(double angle) {
  return {std::sin(angle), 0, std::cos(angle)};
}

TEST(Perpendicular, LikeFeaturesByTheDeviationFromARightAngle) {
  const auto relation = test::relation("perpendicular");
  for (const double angle : {0.0, 0.1, 0.7, pi / 2 - 1e-7, pi / 2}) {
    for (const double sign : {1.0, -1.0}) {
      const RelationResult planes = relate(*relation, circle(tilted(0)), circle(sign * tilted(angle)));
      EXPECT_NEAR(planes.residual, pi / 2 - angle, 1e-12);
      EXPECT_GE(planes.residual, 0);
      EXPECT_EQ(planes.dof, 1);
      EXPECT_NEAR(relate(*relation, segment(tilted(0)), segment(tilted(angle))).residual, pi / 2 - angle, 1e-12);
    }
  }
}

// The cup's handleCon and rim: a segment along the wall stands on the plane of the rim.
TEST(Perpendicular, SegmentIsPerpendicularToAPlaneWhenAlongItsNormal) {
  const auto relation = test::relation("perpendicular");
  const RelationResult stands = relate(*relation, segment(tilted(0.05)), circle(tilted(0)));
  EXPECT_NEAR(stands.residual, 0.05, 1e-12);
  EXPECT_EQ(stands.dof, 2);
  EXPECT_NEAR(relate(*relation, circle(tilted(0)), segment(tilted(pi / 2))).residual, pi / 2, 1e-12);
}

TEST(Perpendicular, ToleranceIsGivenInDegrees) {
  const auto strict = test::relation("perpendicular", {{"tolerance", "5"}});
  const RelationResult result = relate(*strict, circle(tilted(0)), circle(tilted(84 * degree)));
  EXPECT_NEAR(result.tolerance, 5 * degree, 1e-12);
  EXPECT_GT(result.residual, result.tolerance);
}

TEST(Perpendicular, DeviationOfBothFitsAddsUp) {
  Feature first = circle(tilted(0)), second = circle(tilted(1.5));
  first.shape.direction_sd = 0.03;
  second.shape.direction_sd = 0.04;
  EXPECT_NEAR(relate(*test::relation("perpendicular"), first, second).sd, 0.05, 1e-12);
}

TEST(Perpendicular, ClutterDensityIsThatOfRandomDirections) {
  const auto relation = test::relation("perpendicular");
  expect_density_of_random_directions(*relation, circle(Vec3(1, 2, -1)), false);
  expect_density_of_random_directions(*relation, circle(Vec3(1, 2, -1)), true);
  EXPECT_GT(relate(*relation, circle(tilted(0)), segment(tilted(0))).clutter_density, 0);
}

TEST(Perpendicular, PoseScaleAndOrderDoNotMatter) {
  const auto relation = test::relation("perpendicular");
  expect_invariant(*relation, circle(tilted(0.2)), circle(Vec3(1, 1, 1)), 0);
  expect_invariant(*relation, circle(tilted(0.2)), segment(Vec3(1, 1, 1)), 0);
}

TEST(Perpendicular, ShapeWithoutDirectionDoesNotApply) {
  Feature blob = circle(tilted(0));
  blob.shape.orientation = Orientation::none;
  const RelationResult result = relate(*test::relation("perpendicular"), circle(tilted(0)), blob);
  EXPECT_FALSE(result.applicable);
  EXPECT_FALSE(result.why.empty());
}

}  // namespace
