// SPDX-License-Identifier: BSD-3-Clause
// What `parallel` and `perpendicular` have in common.

#include "direction_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

class Directions : public ::testing::TestWithParam<const char*> {
 protected:
  /// A direction at which the relation is violated by `angle` (rad), against the z axis.
  static Vec3 off_by(double angle) { return tilted(std::string(GetParam()) == "parallel" ? angle : pi / 2 - angle); }
};

TEST_P(Directions, ToleranceIsGivenInDegrees) {
  const auto strict = test::relation(GetParam(), {{"tolerance", "5"}});
  const RelationResult result = relate(*strict, circle_about(tilted(0)), circle_about(off_by(6 * degree)));
  EXPECT_NEAR(result.tolerance, 5 * degree, 1e-12);
  EXPECT_NEAR(result.residual, 6 * degree, 1e-12);
  const RelationResult usual = relate(*test::relation(GetParam()), circle_about(tilted(0)), circle_about(tilted(0)));
  EXPECT_NEAR(usual.tolerance, 10 * degree, 1e-12);
}

TEST_P(Directions, DeviationOfBothFitsAddsUpToARightAngle) {
  Feature first = circle_about(tilted(0)), second = circle_about(off_by(0.1));
  first.shape.direction_sd = 0.03;
  second.shape.direction_sd = 0.04;
  EXPECT_NEAR(relate(*test::relation(GetParam()), first, second).sd, 0.05, 1e-12);
  second.shape.direction_sd = 4;
  EXPECT_NEAR(relate(*test::relation(GetParam()), first, second).sd, pi / 2, 1e-12);
}

TEST_P(Directions, ClutterDensityIsThatOfRandomDirections) {
  const auto relation = test::relation(GetParam());
  expect_density_of_random_directions(*relation, circle_about(Vec3(1, 2, -1)), false);
  expect_density_of_random_directions(*relation, circle_about(Vec3(1, 2, -1)), true);
  for (const Feature& other : {circle_about(tilted(0)), segment_along(tilted(0))})
    EXPECT_GT(relate(*relation, circle_about(tilted(0)), other).clutter_density, 0);
}

TEST_P(Directions, PoseScaleAndOrderDoNotMatter) {
  const auto relation = test::relation(GetParam());
  expect_invariant(*relation, circle_about(tilted(0.2)), circle_about(Vec3(1, 1, 1)), 0);
  expect_invariant(*relation, circle_about(tilted(0.2)), segment_along(Vec3(1, 1, 1)), 0);
}

TEST_P(Directions, ShapeWithoutDirectionDoesNotApply) {
  Feature blob = circle_about(tilted(0));
  blob.shape.orientation = Orientation::none;
  for (const RelationResult& result : {relate(*test::relation(GetParam()), blob, circle_about(tilted(0))),
                                       relate(*test::relation(GetParam()), circle_about(tilted(0)), blob)}) {
    EXPECT_FALSE(result.applicable);
    EXPECT_FALSE(result.why.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Directions, ::testing::Values("parallel", "perpendicular"));

}  // namespace
