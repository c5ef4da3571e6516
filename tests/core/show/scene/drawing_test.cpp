// SPDX-License-Identifier: BSD-3-Clause
// Shapes as lines and patches: every point lies on the shape, closed lines are closed, patches have the right area.

#include "scene/drawing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace toposcope {
namespace {

constexpr double rounding = 1e-12;

std::vector<double> list(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}

double area(const Patch& patch) {
  double sum = 0;
  for (const Triangle& t : patch.triangles) {
    const Vec3& a = patch.positions[t[0]];
    sum += (patch.positions[t[1]] - a).cross(patch.positions[t[2]] - a).norm() / 2;
  }
  return sum;
}

/// Six times the volume that an outward oriented patch encloses, about the origin.
double enclosed(const Patch& patch) {
  double sum = 0;
  for (const Triangle& t : patch.triangles)
    sum += patch.positions[t[0]].dot(patch.positions[t[1]].cross(patch.positions[t[2]]));
  return sum;
}

TEST(Drawing, CircleIsAClosedLineOnTheCircle) {
  const Vec3 center(1, 2, 3), normal = Vec3(1, -2, 0.5).normalized();
  const Drawing drawing = draw_shape(
      std::vector<ShapeParameter>{{"center", 3, list(center)}, {"normal", 3, list(normal)}, {"radius", 1, {5}}}, {});
  ASSERT_EQ(drawing.lines.size(), 1U);
  EXPECT_TRUE(drawing.patches.empty());
  EXPECT_EQ(drawing.lines[0].front(), drawing.lines[0].back());
  double length = 0;
  for (std::size_t i = 1; i < drawing.lines[0].size(); ++i) {
    const Vec3 arm = drawing.lines[0][i] - center;
    EXPECT_NEAR(arm.norm(), 5, rounding);
    EXPECT_NEAR(arm.dot(normal), 0, rounding);
    length += (drawing.lines[0][i] - drawing.lines[0][i - 1]).norm();
  }
  EXPECT_NEAR(length, 2 * pi * 5, 2 * pi * 5 * 1e-3);
}

TEST(Drawing, PlaneEndsAtTheHullOfItsRegion) {
  std::vector<Vec3> region;  // a square of side 4 with its inside, above and below the plane z = 7
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) region.emplace_back(i, j, 7 + 0.1 * ((i + j) % 2));
  const std::vector<ShapeParameter> plane = {{"point", 3, {0, 0, 7}}, {"normal", 3, {0, 0, 1}}};
  const Drawing drawing = draw_shape(plane, region);
  ASSERT_EQ(drawing.patches.size(), 1U);
  EXPECT_EQ(drawing.patches[0].positions.size(), 4U);
  EXPECT_NEAR(area(drawing.patches[0]), 16, rounding);
  for (const Vec3& p : drawing.patches[0].positions) EXPECT_NEAR(p.z(), 7, rounding);
  ASSERT_EQ(drawing.lines.size(), 1U);
  EXPECT_EQ(drawing.lines[0].size(), 5U);
  EXPECT_EQ(drawing.lines[0].front(), drawing.lines[0].back());
  EXPECT_TRUE(draw_shape(plane, {}).empty());
  EXPECT_TRUE(draw_shape(plane, std::vector<Vec3>{{0, 0, 7}, {1, 1, 7}, {2, 2, 7}}).empty());  // a line
}

TEST(Drawing, LineGroupsAreTheirSegments) {
  std::vector<ShapeParameter> group = {{"endpoints", 3, {0, 0, 0, 1, 0, 0, 1, 1, 0}}, {"closed", 1, {0}}};
  EXPECT_EQ(draw_shape(group, {}).lines[0].size(), 3U);
  group[1].values = {1};
  const Drawing closed = draw_shape(group, {});
  ASSERT_EQ(closed.lines[0].size(), 4U);
  EXPECT_EQ(closed.lines[0].back(), Vec3(0, 0, 0));
  EXPECT_EQ(closed.points.size(), 3U);
}

TEST(Drawing, SpheresAndCylindersFaceOutwards) {
  const Drawing ball = draw_shape(std::vector<ShapeParameter>{{"center", 3, {0, 0, 0}}, {"radius", 1, {2}}}, {});
  for (const Vec3& p : ball.patches.at(0).positions) EXPECT_NEAR(p.norm(), 2, rounding);
  EXPECT_NEAR(enclosed(ball.patches[0]) / 6, 4 * pi / 3 * 8, 0.03 * 4 * pi / 3 * 8);  // a little less: chords
  const Drawing tube =
      draw_shape(std::vector<ShapeParameter>{{"point", 3, {0, 0, 1}}, {"axis", 3, {0, 0, 1}}, {"radius", 1, {3}}},
                 std::vector<Vec3>{{3, 0, -1}, {0, 3, 4}});
  EXPECT_NEAR(area(tube.patches.at(0)), 2 * pi * 3 * 5, 0.01 * 2 * pi * 3 * 5);
  EXPECT_GT(enclosed(tube.patches[0]), 0);
  ASSERT_EQ(tube.lines.size(), 2U);
  EXPECT_NEAR(tube.lines[0][0].z(), -1, rounding);
  EXPECT_NEAR(tube.lines[1][0].z(), 4, rounding);
}

TEST(Drawing, ConesEndWithTheirRegionAndFaceOutwards) {
  const std::vector<ShapeParameter> cone = {
      {"apex", 3, {0, 0, 1}}, {"axis", 3, {0, 0, 1}}, {"half_angle", 1, {45}}};  // degrees
  const Drawing whole = draw_shape(cone, std::vector<Vec3>{{0, 0, 1}, {0, 3, 4}});
  const double expected = pi * 3 * std::sqrt(18.0);
  EXPECT_NEAR(area(whole.patches.at(0)), expected, 0.01 * expected);
  EXPECT_EQ(whole.lines.size(), 1U);
  const Drawing cut = draw_shape(cone, std::vector<Vec3>{{1, 0, 2}, {0, 3, 4}});
  ASSERT_EQ(cut.lines.size(), 2U);
  for (const std::vector<Vec3>& line : cut.lines)
    for (const Vec3& p : line) EXPECT_NEAR(std::hypot(p.x(), p.y()), p.z() - 1, rounding);
  EXPECT_NEAR(cut.lines[0][0].z(), 2, rounding);
  EXPECT_NEAR(cut.lines[1][0].z(), 4, rounding);
  // Outwards is away from the axis.
  const Triangle& t = cut.patches.at(0).triangles[0];
  const std::vector<Vec3>& at = cut.patches[0].positions;
  const Vec3 normal = (at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]), middle = (at[t[0]] + at[t[1]] + at[t[2]]) / 3;
  EXPECT_GT(normal.dot(Vec3(middle.x(), middle.y(), 0)), 0);
  EXPECT_TRUE(draw_shape(cone, {}).empty());
}

TEST(Drawing, ToriAreClosed) {
  const Drawing ring = draw_shape(
      std::vector<ShapeParameter>{
          {"center", 3, {0, 0, 0}}, {"axis", 3, {0, 0, 1}}, {"major_radius", 1, {5}}, {"minor_radius", 1, {2}}},
      {});
  const auto on_torus = [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 5, p.z()); };
  for (const Vec3& p : ring.patches.at(0).positions) EXPECT_NEAR(on_torus(p), 2, rounding);
  for (const std::vector<Vec3>& line : ring.lines)
    for (const Vec3& p : line) EXPECT_NEAR(on_torus(p), 2, rounding);
  EXPECT_EQ(ring.lines.size(), 6U);
  const double volume = 2 * pi * pi * 5 * 4;
  EXPECT_NEAR(enclosed(ring.patches[0]) / 6, volume, 0.04 * volume);
}

TEST(Drawing, ShapesOfOthersAreTheirOutline) {
  const std::vector<Vec3> outline = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const std::vector<ShapeParameter> helix = {{"pitch", 1, {2}}};
  EXPECT_EQ(draw_shape(helix, {}, outline, false).lines.at(0), outline);
  EXPECT_EQ(draw_shape(helix, {}, outline, true).lines.at(0).size(), 4U);
  EXPECT_TRUE(draw_shape(helix, {}).empty());
}

}  // namespace
}  // namespace toposcope
