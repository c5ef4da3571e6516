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

TEST(Parallel, LikeFeaturesByTheAngleOfTheirLines) {
  const auto relation = test::relation("parallel");
  for (const double angle : {0.0, 1e-7, 0.1, 0.7, pi / 2}) {
    for (const double sign : {1.0, -1.0}) {  // the sign of a normal means nothing
      const RelationResult planes = relate(*relation, circle(tilted(0)), circle(sign * tilted(angle)));
      EXPECT_NEAR(planes.residual, angle, 1e-12);
      EXPECT_EQ(planes.dof, 2);
      EXPECT_NEAR(relate(*relation, segment(tilted(0)), segment(sign * tilted(angle))).residual, angle, 1e-12);
    }
  }
}

TEST(Parallel, SegmentIsParallelToAPlaneWhenPerpendicularToItsNormal) {
  const auto relation = test::relation("parallel");
  const RelationResult lies = relate(*relation, circle(tilted(0)), segment(tilted(pi / 2 - 0.05)));
  EXPECT_NEAR(lies.residual, 0.05, 1e-12);
  EXPECT_EQ(lies.dof, 1);
  EXPECT_NEAR(relate(*relation, segment(tilted(0)), circle(tilted(0))).residual, pi / 2, 1e-12);
}

TEST(Parallel, ToleranceIsGivenInDegrees) {
  const auto strict = test::relation("parallel", {{"tolerance", "5"}});
  const RelationResult result = relate(*strict, circle(tilted(0)), circle(tilted(6 * degree)));
  EXPECT_NEAR(result.tolerance, 5 * degree, 1e-12);
  EXPECT_GT(result.residual, result.tolerance);
  EXPECT_NEAR(relate(*test::relation("parallel"), circle(tilted(0)), circle(tilted(0))).tolerance, 10 * degree, 1e-12);
}

TEST(Parallel, DeviationOfBothFitsAddsUp) {
  Feature first = circle(tilted(0)), second = circle(tilted(0.1));
  first.shape.direction_sd = 0.03;
  second.shape.direction_sd = 0.04;
  EXPECT_NEAR(relate(*test::relation("parallel"), first, second).sd, 0.05, 1e-12);
}

TEST(Parallel, ClutterDensityIsThatOfRandomDirections) {
  const auto relation = test::relation("parallel");
  expect_density_of_random_directions(*relation, circle(Vec3(1, 2, -1)), false);
  expect_density_of_random_directions(*relation, circle(Vec3(1, 2, -1)), true);
  EXPECT_GT(relate(*relation, circle(tilted(0)), circle(tilted(0))).clutter_density, 0);
}

TEST(Parallel, PoseScaleAndOrderDoNotMatter) {
  const auto relation = test::relation("parallel");
  expect_invariant(*relation, circle(tilted(0.2)), circle(Vec3(1, 1, 1)), 0);
  expect_invariant(*relation, circle(tilted(0.2)), segment(Vec3(1, 1, 1)), 0);
}

TEST(Parallel, ShapeWithoutDirectionDoesNotApply) {
  Feature blob = circle(tilted(0));
  blob.shape.orientation = Orientation::none;
  const RelationResult result = relate(*test::relation("parallel"), blob, circle(tilted(0)));
  EXPECT_FALSE(result.applicable);
  EXPECT_FALSE(result.why.empty());
}

}  // namespace
