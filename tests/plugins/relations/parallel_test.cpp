// SPDX-License-Identifier: BSD-3-Clause
#include "direction_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

TEST(Parallel, LikeFeaturesByTheAngleOfTheirLines) {
  const auto relation = test::relation("parallel");
  for (const double angle : {0.0, 1e-7, 0.1, 0.7, pi / 2}) {
    for (const double sign : {1.0, -1.0}) {  // the sign of a normal means nothing
      const RelationResult planes = relate(*relation, circle_about(tilted(0)), circle_about(sign * tilted(angle)));
      EXPECT_NEAR(planes.residual, angle, 1e-12);
      EXPECT_EQ(planes.dof, 2);
      EXPECT_NEAR(relate(*relation, segment_along(tilted(0)), segment_along(sign * tilted(angle))).residual, angle,
                  1e-12);
    }
  }
}

TEST(Parallel, SegmentIsParallelToAPlaneWhenPerpendicularToItsNormal) {
  const auto relation = test::relation("parallel");
  const RelationResult lies = relate(*relation, circle_about(tilted(0)), segment_along(tilted(pi / 2 - 0.05)));
  EXPECT_NEAR(lies.residual, 0.05, 1e-12);
  EXPECT_EQ(lies.dof, 1);
  EXPECT_NEAR(relate(*relation, segment_along(tilted(0)), circle_about(tilted(0))).residual, pi / 2, 1e-12);
}

}  // namespace
