// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"
#include "toposcope/geometry/lines.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

Feature ring(const Vec3& center, const Vec3& normal = Vec3::UnitZ(), double radius = 1, int count = 48) {
  Feature feature = circle_feature(center, normal, radius);
  const Vec3 u = any_perpendicular(feature.shape.direction), v = feature.shape.direction.cross(u);
  for (int i = 0; i < count; ++i)
    feature.shape.outline.push_back(center +
                                    radius * (std::cos(2 * i * pi / count) * u + std::sin(2 * i * pi / count) * v));
  return feature;
}
/// The corners of a box 2 x 1 x 0.5 about a point, of a shape without direction.
Feature block(const Vec3& center) {
  Feature feature = points_feature({});
  for (int i = 0; i < 8; ++i)
    feature.points.push_back(center + Vec3(i & 1 ? 1 : -1, i & 2 ? 0.5 : -0.5, i & 4 ? 0.25 : -0.25));
  feature.shape.orientation = Orientation::none;
  feature.shape.centroid = center;
  return feature;
}
RelationResult inside(const Feature& first, const Feature& second, const Motion& motion = {}) {
  return relate(*test::relation("inside"), first, second, motion);
}

TEST(Inside, ACircleInADiskAtAnyHeight) {
  for (const double height : {0.0, 0.7, -3.0}) {
    EXPECT_EQ(inside(ring({0.4, 0.2, height}, Vec3::UnitZ(), 0.5), ring({0, 0, 0})).residual, 0);
    EXPECT_NEAR(inside(ring({0.8, 0, height}, Vec3::UnitZ(), 0.5), ring({0, 0, 0})).residual, 0.3, 5e-3);
    EXPECT_NEAR(inside(ring({0, 3, height}, Vec3::UnitX(), 0.5), ring({0, 0, 0})).residual, 2.5, 5e-3);
  }
  EXPECT_NEAR(inside(ring({0, 0, 0}), ring({0, 0, 0}, Vec3::UnitZ(), 0.5)).residual, 0.5, 5e-3) << "the larger is not";
}

/// A square's corner: the distance is that to the corner, not to the sides.
TEST(Inside, APolygonEndsAtItsCorners) {
  Feature square = circle_feature({0, 0, 0}, Vec3::UnitZ(), 1);
  square.shape.outline = {{1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0.9, 0, 0}};
  Feature point = circle_feature({4, 5, 2}, Vec3::UnitZ(), 1);
  EXPECT_NEAR(inside(point, square).residual, 5, 1e-12);
  point.shape.centroid = {0.95, 0.9, 0};
  EXPECT_EQ(inside(point, square).residual, 0) << "the dent does not count";
  EXPECT_NEAR(inside(point, square).slack, std::sqrt(4 / pi), 1e-9);
}

TEST(Inside, OtherShapesAreTheirBox) {
  EXPECT_EQ(inside(ring({0.5, 0, 0}, Vec3::UnitZ(), 0.4), block({0, 0, 0})).residual, 0);
  EXPECT_NEAR(inside(ring({0.9, 0, 0}, Vec3::UnitZ(), 0.4), block({0, 0, 0})).residual, 0.3, 5e-3);
  EXPECT_NEAR(inside(circle_feature({4, 4.5, 0}, Vec3::UnitZ(), 1), block({0, 0, 0})).residual, 5, 1e-9);
}

TEST(Inside, SaysWhatTheKernelNeeds) {
  Feature inner = ring({0, 0, 2}, Vec3::UnitZ(), 0.3), outer = ring({0, 0, 0});
  inner.shape.centroid_sd = 0.03, outer.shape.centroid_sd = 0.04, outer.shape.direction_sd = 0.06;
  const RelationResult disk = inside(inner, outer);
  EXPECT_NEAR(disk.tolerance, 0.1, 1e-3);
  EXPECT_NEAR(disk.sd, std::hypot(0.05, 0.12), 1e-9);
  EXPECT_EQ(disk.dof, 1);
  EXPECT_NEAR(disk.slack * disk.clutter_density, 0.25, 2e-3) << "a disk of radius 1 in one of radius 2";
  const RelationResult box = inside(inner, block({0, 0, 0}));
  EXPECT_NEAR(box.tolerance, 0.1, 1e-9);
  EXPECT_NEAR(box.slack, 0.35, 1e-9);
  EXPECT_NEAR(box.slack * box.clutter_density, (2.2 * 1.2 * 0.7) / (4.2 * 3.2 * 2.2), 1e-9);
}

TEST(Inside, PoseAndScaleDoNotMatter) {
  Feature inner = ring({1.5, 0.1, 2}, {0, 1, 1}, 0.3), outer = ring({0, 0, 0}, {0.2, 0.3, 1});
  outer.shape.direction_sd = 0.06;
  for (const Feature& second : {outer, block({0, 0.1, 2.5})}) {
    const RelationResult here = inside(inner, second);
    EXPECT_GT(here.residual, 0.05);
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const Motion motion = some_motion(seed);
      const RelationResult there = inside(inner, second, motion);
      EXPECT_NEAR(there.residual / motion.scale, here.residual, 1e-9);
      EXPECT_NEAR(there.tolerance / motion.scale, here.tolerance, 1e-9);
      EXPECT_NEAR(there.sd / motion.scale, here.sd, 1e-9);
      EXPECT_NEAR(there.clutter_density * motion.scale, here.clutter_density, 1e-9);
    }
  }
}

TEST(Inside, NeedsAnExtent) {
  EXPECT_FALSE(inside(ring({0, 0, 0}), circle_feature({0, 0, 0}, Vec3::UnitZ(), 1)).applicable) << "no outline";
  EXPECT_FALSE(inside(ring({0, 0, 0}), segment_feature({0, 0, 0}, {1, 0, 0})).applicable) << "no points";
}

}  // namespace
