// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"
#include "toposcope/geometry/lines.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

Feature ring(const Vec3& center, const Vec3& normal, double radius) {
  Feature feature = circle_feature(center, normal, radius);
  const Vec3 u = any_perpendicular(normal.normalized()), v = normal.normalized().cross(u);
  for (int i = 0; i < 32; ++i)
    feature.shape.outline.push_back(center + radius * (std::cos(i * pi / 16) * u + std::sin(i * pi / 16) * v));
  return feature;
}

/// An open pipe of radius 1 from z = -2 to 2.
RelationResult at(const Feature& feature, const Motion& motion = {}) {
  const Mesh mesh(transformed(make_cylinder(1, 4, 48, 24, false), motion.rotation, motion.scale, motion.translation),
                  "pipe");
  const Feature there = moved(feature, motion);
  const RelationOperand operand{&there.shape, {}, {}};
  Box box;
  box.sides = {4 * motion.scale, 2 * motion.scale, 2 * motion.scale};
  return test::relation("end")->test({{&operand, 1}, box, 0.1 * motion.scale, &mesh.view()}, {}, context());
}

TEST(End, APipeEndsAtItsOpeningsOnly) {
  EXPECT_NEAR(at(ring({0, 0, 2}, Vec3::UnitZ(), 1)).residual, 0, 1e-12);
  EXPECT_NEAR(at(ring({0, 0, -2}, Vec3::UnitZ(), 1)).residual, 0, 1e-12);
  EXPECT_NEAR(at(ring({0, 0, 1.5}, Vec3::UnitZ(), 1)).residual, 0.5, 1e-12) << "half a unit goes on";
  EXPECT_NEAR(at(ring({0, 0, 0}, -Vec3::UnitZ(), 1)).residual, 2, 1e-12);
  EXPECT_NEAR(at(ring({0, 0, 3}, Vec3::UnitZ(), 1)).residual, 0, 1e-12) << "outside of the object it ends too";
}

TEST(End, OnlyWhatIsNearTheAxisCounts) {
  // A small ring on the wall: the pipe is narrower within reach of its axis than it is wide.
  EXPECT_LT(at(ring({1, 0, 0}, Vec3::UnitX(), 0.3)).residual, 0.07);
  EXPECT_GT(at(ring({0, 0, 0.5}, Vec3::UnitX(), 1)).residual, 0.9) << "a plane through the pipe's middle";
}

TEST(End, SaysWhatTheKernelNeeds) {
  Feature feature = ring({0, 0, 2}, Vec3::UnitZ(), 1);
  feature.shape.centroid_sd = 0.3;
  feature.shape.direction_sd = 1.0 / 3;
  const RelationResult result = at(feature);
  EXPECT_NEAR(result.tolerance, 0.2, 1e-12);
  EXPECT_NEAR(result.sd, 0.5, 1e-12) << "reach 1.2 times a third is 0.4";
  EXPECT_NEAR(result.clutter_density, 6.0 / 8, 1e-12);
  EXPECT_EQ(result.dof, 1);
}

TEST(End, PoseAndScaleDoNotMatter) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Motion motion = some_motion(seed);
    const RelationResult there = at(ring({0, 0, 1.5}, Vec3::UnitZ(), 1), motion);
    EXPECT_NEAR(there.residual / motion.scale, 0.5, 1e-9);
    EXPECT_NEAR(there.tolerance / motion.scale, 0.2, 1e-9);
    EXPECT_NEAR(there.clutter_density * motion.scale, 6.0 / 8, 1e-9);
  }
}

TEST(End, DoesNotApplyToShapesWithoutPlaneOrExtent) {
  EXPECT_FALSE(at(segment_feature(Vec3::Zero(), Vec3::UnitZ())).applicable);
  EXPECT_FALSE(at(circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1)).applicable) << "no outline";
}

}  // namespace
