// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

/// `self` against `near` at x = 1 and `far` at x = -1.
RelationResult nearer(const Vec3& self, const Motion& motion = {}, double near_x = 1) {
  const Feature features[] = {moved(circle_feature(self, Vec3::UnitZ(), 1), motion),
                              moved(circle_feature(Vec3(near_x, 0, 0), Vec3::UnitZ(), 1), motion),
                              moved(circle_feature(Vec3(-1, 0, 0), Vec3::UnitZ(), 1), motion)};
  std::vector<RelationOperand> operands;
  for (const Feature& feature : features) operands.push_back({&feature.shape, feature.points, {}});
  Box box;
  box.sides = {4 * motion.scale, 3 * motion.scale, 2 * motion.scale};
  return test::relation("nearer")->test({operands, box, 0.1 * motion.scale}, {}, context());
}

TEST(Nearer, ResidualIsByHowMuchTheThirdIsNearer) {
  EXPECT_EQ(nearer({0.5, 3, 1}).residual, 0);
  EXPECT_NEAR(nearer({-3, 0, 0}).residual, 2, 1e-12);
  EXPECT_NEAR(nearer({-0.5, 0, 0}).residual, 1, 1e-12);
  EXPECT_NEAR(nearer({0, 3, 1}).residual, 0, 1e-12);
}

/// The difference lies within the distance of the two: its density under clutter integrates to one over twice that.
TEST(Nearer, HoldingIsWorthOneBit) {
  const RelationResult result = nearer({0.5, 0, 0});
  EXPECT_NEAR(result.slack * result.clutter_density, 0.5, 1e-12);
  EXPECT_NEAR(result.tolerance, 0.04, 1e-12);
}

TEST(Nearer, PoseAndScaleDoNotMatter) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Motion motion = some_motion(seed);
    EXPECT_NEAR(nearer({-0.5, 0.2, 0}, motion).residual / motion.scale, nearer({-0.5, 0.2, 0}).residual, 1e-9);
  }
}

TEST(Nearer, DoesNotApplyToOnePlace) {
  EXPECT_FALSE(nearer({0, 1, 0}, {}, -1).applicable);
}

}  // namespace
