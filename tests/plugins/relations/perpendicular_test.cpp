// SPDX-License-Identifier: BSD-3-Clause
#include "direction_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

TEST(Perpendicular, LikeFeaturesByTheDeviationFromARightAngle) {
  const auto relation = test::relation("perpendicular");
  for (const double angle : {0.0, 0.1, 0.7, pi / 2 - 1e-7, pi / 2}) {
    for (const double sign : {1.0, -1.0}) {
      const RelationResult planes = relate(*relation, circle_about(tilted(0)), circle_about(sign * tilted(angle)));
      EXPECT_NEAR(planes.residual, pi / 2 - angle, 1e-12);
      EXPECT_GE(planes.residual, 0);
      EXPECT_EQ(planes.dof, 1);
      EXPECT_NEAR(relate(*relation, segment_along(tilted(0)), segment_along(tilted(angle))).residual, pi / 2 - angle,
                  1e-12);
    }
  }
}

// The cup's handleCon and rim: a segment along the wall stands on the plane of the rim.
TEST(Perpendicular, SegmentIsPerpendicularToAPlaneWhenAlongItsNormal) {
  const auto relation = test::relation("perpendicular");
  const RelationResult stands = relate(*relation, segment_along(tilted(0.05)), circle_about(tilted(0)));
  EXPECT_NEAR(stands.residual, 0.05, 1e-12);
  EXPECT_EQ(stands.dof, 2);
  EXPECT_NEAR(relate(*relation, circle_about(tilted(0)), segment_along(tilted(pi / 2))).residual, pi / 2, 1e-12);
}

}  // namespace
