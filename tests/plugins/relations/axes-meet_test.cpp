// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

/// Circles about the x axis and about a line along y at height `gap` above it, each `reach` from where they are
/// nearest.
RelationResult apart(double gap, double reach, double direction_sd = 0, const Motion& motion = {}) {
  Feature first = circle_feature(Vec3(reach, 0, 0), Vec3::UnitX(), 1);
  Feature second = circle_feature(Vec3(0, -reach, gap), Vec3::UnitY(), 1);
  first.shape.direction_sd = second.shape.direction_sd = direction_sd;
  first.shape.centroid_sd = 0.1;
  return relate(*test::relation("axes-meet"), first, second, motion);
}

TEST(AxesMeet, ResidualIsTheDistanceOfTheAxes) {
  EXPECT_NEAR(apart(0, 3).residual, 0, 1e-12);
  EXPECT_NEAR(apart(0.25, 3).residual, 0.25, 1e-12);
  EXPECT_NEAR(apart(0.25, 100).residual, 0.25, 1e-9) << "however far away";
}

TEST(AxesMeet, ErrorsOfDirectionsActOverTheWay) {
  EXPECT_NEAR(apart(0, 3, 0).sd, 0.1, 1e-12);
  EXPECT_NEAR(apart(0, 3, 0.2).sd, std::sqrt(0.01 + 2 * 0.36), 1e-12);
}

TEST(AxesMeet, SaysWhatTheKernelNeeds) {
  const RelationResult result = apart(0.25, 3);
  EXPECT_NEAR(result.tolerance, 0.02 * std::sqrt(29.0), 1e-12);
  EXPECT_NEAR(result.clutter_density, 6.0 / 9, 1e-12);
  EXPECT_EQ(result.dof, 1);
}

TEST(AxesMeet, PoseScaleAndOrderDoNotMatter) {
  expect_invariant(*test::relation("axes-meet"), circle_feature(Vec3(1, 0, 0), Vec3(1, 0.3, 0), 1),
                   segment_feature(Vec3(0, 2, 0.5), Vec3(0.5, 3, 0.5)), 1);
}

TEST(AxesMeet, ParallelAxesMeetNowhere) {
  const auto relation = test::relation("axes-meet");
  EXPECT_FALSE(relate(*relation, circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1),
                      circle_feature(Vec3::UnitX(), Vec3(0.05, 0, 1), 1))
                   .applicable);
}

}  // namespace
