// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

/// A feature at `self` with an outline, between features at x = 1 and at `other`.
RelationResult between(const Vec3& self, std::vector<Vec3> outline, const Motion& motion = {},
                       const Vec3& other = -Vec3::UnitX(), int order = 0) {
  Feature features[] = {moved(circle_feature(self, Vec3::UnitX(), 1), motion),
                        moved(circle_feature(Vec3::UnitX(), Vec3::UnitZ(), 1), motion),
                        moved(circle_feature(other, Vec3::UnitZ(), 1), motion)};
  for (Vec3& point : outline) point = motion(point);
  features[0].shape.outline = outline;
  std::rotate(features, features + order, features + 3);
  std::vector<RelationOperand> operands;
  for (const Feature& feature : features) operands.push_back({&feature.shape, feature.points, {}});
  Box box;
  box.sides = {4 * motion.scale, 3 * motion.scale, 2 * motion.scale};
  return test::relation("mirror-plane")->test({operands, box, 0.1 * motion.scale}, {}, context());
}

TEST(MirrorPlane, ResidualIsTheDistanceFromThePlane) {
  EXPECT_NEAR(between({0, 3, 1}, {{0, 1, 5}, {0, -2, 7}}).residual, 0, 1e-12);
  EXPECT_NEAR(between({0.5, 3, 1}, {}).residual, 0.5, 1e-12);
  EXPECT_NEAR(between({0, 0, 0}, {{0.3, 2, 2}, {-0.3, 0, 1}, {0.3, 0, 0}}).residual, std::sqrt(0.27 / 4), 1e-12);
  EXPECT_NEAR(between({0.1, 3, 1}, {}, {}, {-1, 0.2, 0}).residual, (2.9 * 0.2 - 0.1 * 2) / std::hypot(2, 0.2), 1e-12);
  EXPECT_NEAR(between({0, 3, 1}, {}).tolerance, 0.2, 1e-12);
}

/// Turned about an axis in the plane by an angle, an outline from -1 to 1 leaves it by sin / sqrt(3).
TEST(MirrorPlane, AnOutlineThatCrossesThePlaneIsOff) {
  std::vector<Vec3> outline;
  for (int i = -200; i <= 200; ++i) outline.push_back(i / 200.0 * Vec3(std::sin(0.4), 0, std::cos(0.4)));
  EXPECT_NEAR(between({0, 0, 0}, outline).residual, std::sin(0.4) / std::sqrt(3), 0.02);
}

TEST(MirrorPlane, PoseScaleAndOrderDoNotMatter) {
  const std::vector<Vec3> outline = {{0.1, 1, 5}, {0.2, -2, 7}};
  const double here = between({0.3, 2, 1}, outline).residual;
  for (const int order : {1, 2})
    EXPECT_NEAR(between({0.3, 2, 1}, outline, {}, -Vec3::UnitX(), order).residual, here, 1e-12);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Motion motion = some_motion(seed);
    EXPECT_NEAR(between({0.3, 2, 1}, outline, motion).residual / motion.scale, here, 1e-9);
  }
}

TEST(MirrorPlane, DoesNotApplyWhereTwoAreInOnePlace) {
  EXPECT_FALSE(between({0, 1, 0}, {}, {}, Vec3::UnitX()).applicable);
  EXPECT_FALSE(between(Vec3::UnitX(), {}).applicable);
}

}  // namespace
