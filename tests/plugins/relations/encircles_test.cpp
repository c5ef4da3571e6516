// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

const double diagonal = std::sqrt(16.0 + 9 + 4);  // of the fixture's object box

/// With its outline, as fits have it.
Feature ring(const Vec3& center, double radius, const Vec3& normal = Vec3::UnitZ()) {
  Feature feature = circle_feature(center, normal, radius);
  const Vec3 n = normal.normalized(), u = any_perpendicular(n), v = n.cross(u);
  for (int i = 0; i < 360; ++i)
    feature.shape.outline.push_back(center + radius * (std::cos(i * pi / 180) * u + std::sin(i * pi / 180) * v));
  return feature;
}

TEST(Encircles, SeenAlongTheFirstsAxis) {
  EXPECT_EQ(relate_all("encircles", {ring({0, 0, 0}, 2), ring({0, 0, 5}, 1.5)}).residual, 0);
  EXPECT_NEAR(relate_all("encircles", {ring({0, 0, 0}, 2), ring({0, 0, 5}, 2.5)}).residual, 0.5, 1e-9);
  EXPECT_NEAR(relate_all("encircles", {ring({0, 0, 0}, 2), ring({1, 0, 0}, 1.5)}).residual, 0.5, 1e-3);
  EXPECT_EQ(relate_all("encircles", {ring({0, 0, 0}, 2), ring({0, 0, 0}, 1.9, Vec3::UnitX())}).residual, 0);
  EXPECT_NEAR(relate_all("encircles", {ring({0, 0, 0}, 2), ring({0, 0, 0}, 1.5)}, {{"clearance", "0.75"}}).residual,
              0.25, 1e-9);
}

TEST(Encircles, SaysWhatTheKernelNeeds) {
  Feature outer = ring({0, 0, 0}, 2);
  outer.shape.direction_sd = 0.1;
  outer.shape.measures[0].sd = 0.2;
  Feature inner = ring({0, 0, 3}, 1);
  inner.shape.centroid_sd = 0.3;
  const RelationResult result = relate_all("encircles", {outer, inner});
  EXPECT_NEAR(result.sd, std::hypot(0.3, 0.2, 0.3), 1e-9);
  EXPECT_NEAR(result.slack, 2, 1e-12);
  EXPECT_NEAR(result.tolerance, 0.04, 1e-12);
  EXPECT_NEAR(result.clutter_density, 1 / diagonal, 1e-12);
}

TEST(Encircles, TheFirstMustBeRound) {
  EXPECT_FALSE(relate_all("encircles", {segment_feature(Vec3::Zero(), Vec3::UnitX()), ring({0, 0, 0}, 1)}).applicable);
  Feature torus = ring({0, 0, 0}, 2);
  torus.shape.measures = {{"major_radius", 2, 0}};
  EXPECT_EQ(relate_all("encircles", {torus, ring({0, 0, 0}, 1)}).residual, 0);
}

TEST(Encircles, PoseAndScaleDoNotMatter) {
  expect_pose_does_not_matter("encircles", {ring({0, 0, 0}, 2, {1, 2, 3}), ring({1, 0, 0}, 1.5, {0, 1, 0})});
}

}  // namespace
