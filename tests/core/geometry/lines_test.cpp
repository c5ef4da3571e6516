// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/lines.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace toposcope {
namespace {

TEST(AnyPerpendicular, IsAUnitVectorAcross) {
  for (const Vec3& v : {Vec3(1, 0, 0), Vec3(0, -3, 0), Vec3(1e-9, 2, 1e9), Vec3(1, 1, 1), Vec3(-1e-80, 2e-80, 1e-80)}) {
    const Vec3 across = any_perpendicular(v);
    EXPECT_NEAR(across.norm(), 1, 1e-15);
    EXPECT_NEAR(across.dot(v.stableNormalized()), 0, 1e-15);
  }
}

TEST(LineAngle, KeepsTheDigitsOfSmallAngles) {
  for (double angle : {1e-12, 1e-6, 0.3, 1.5}) {
    const Vec3 u(2, 0, 0), v(3 * std::cos(angle), 3 * std::sin(angle), 0);
    EXPECT_NEAR(line_angle(u, v), angle, 1e-15 + 1e-14 * angle);
    EXPECT_NEAR(line_angle(u, -v), angle, 1e-15 + 1e-14 * angle) << "lines have no sense of direction";
  }
  EXPECT_NEAR(line_angle(Vec3::UnitX(), Vec3::UnitY()), pi / 2, 1e-15);
}

TEST(ClosestOnSegment, InsideAtTheEndsAndOnASegmentWithoutLength) {
  const Vec3 p(0, 0, 0), q(4, 0, 0);
  const SegmentPoint inside = closest_on_segment(p, q, {1, 5, 0});
  EXPECT_EQ(inside.point, Vec3(1, 0, 0));
  EXPECT_EQ(inside.t, 0.25);
  EXPECT_EQ(closest_on_segment(p, q, {-1, 5, 0}).t, 0);
  EXPECT_EQ(closest_on_segment(p, q, {9, 5, 0}).point, q);
  EXPECT_EQ(closest_on_segment(p, p, {9, 5, 0}).point, p);
}

TEST(Resample, KeepsCornersAndSpacing) {
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 0, 0}, {1, 0.35, 0}};
  const std::vector<Vec3> points = resample(line, 0.25);
  ASSERT_EQ(points.size(), 1 + 4 + 2);
  EXPECT_EQ(points.front(), line.front());
  EXPECT_EQ(points[4], line[1]);
  EXPECT_EQ(points.back(), line.back());
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LE((points[i] - points[i - 1]).norm(), 0.25 * (1 + 1e-12));
}

TEST(Resample, StaysWithinTheLimit) {
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}, {5, 3, 0}};
  for (std::size_t limit : {4U, 5U, 10U, 100U, 512U}) {
    const std::vector<Vec3> points = resample(line, 1e-9, limit);
    EXPECT_LE(points.size(), limit);
    EXPECT_GE(points.size() + line.size(), limit) << "the limit is made use of";
    EXPECT_EQ(points.back(), line.back());
  }
  EXPECT_EQ(resample(line, 1e-9, 2).size(), 2U);
  EXPECT_EQ(resample(std::vector<Vec3>{{1, 2, 3}}, 1).size(), 1U);
  EXPECT_TRUE(resample({}, 1).empty());
  EXPECT_EQ(resample(std::vector<Vec3>(3, Vec3(1, 2, 3)), 1).size(), 3U) << "segments without length";
}

}  // namespace
}  // namespace toposcope
