// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "support/random.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/turn_coverage.h"

namespace toposcope {
namespace {

std::vector<Vec3> cloud(std::size_t count, test::Random& random) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(random.normal(), random.normal(), random.normal());
  return points;
}

TEST(LeastDistance, IsThatOfBruteForce) {
  test::Random random(3);
  for (const std::size_t count : {1U, 2U, 9U, 11U, 200U}) {
    const std::vector<Vec3> first = cloud(count, random), second = cloud(70, random);
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : first)
      for (const Vec3& q : second) least = std::min(least, (p - q).norm());
    EXPECT_NEAR(least_distance(first, second), least, 1e-15);
    EXPECT_EQ(least_distance(first, second), least_distance(second, first));
  }
  const std::vector<Vec3> same(30, Vec3(1, 2, 3));
  EXPECT_EQ(least_distance(same, same), 0);
}

/// From whatever side: no point sticks out of the outline, and each corner does out of the others.
TEST(ConvexOutline, IsCounterClockwiseAndHoldsAllPoints) {
  test::Random random(4);
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(1, -2, 0.5), Vec3(-3, 0, 0)}) {
    const std::vector<Vec3> points = cloud(100, random);
    const std::vector<Index> outline = convex_outline(points, direction.normalized());
    ASSERT_GT(outline.size(), 4U);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 &a = points[outline[i]], &b = points[outline[(i + 1) % outline.size()]];
      for (const Vec3& p : points) EXPECT_GE(direction.dot((b - a).cross(p - a)), -1e-9);
    }
  }
  EXPECT_EQ(convex_outline(std::vector<Vec3>{{0, 0, 0}, {0, 0, 5}}, Vec3::UnitZ()).size(), 2U) << "twice";
  EXPECT_EQ(convex_outline(std::vector<Vec3>{{0, 0, 0}, {1, 1, 5}, {2, 2, 1}}, Vec3::UnitZ()).size(), 2U);
}

TEST(TurnCoverage, CountsArcsWithinHalfAnEdge) {
  TurnCoverage covered(100);
  EXPECT_EQ(covered.part(), 0);
  for (int i = 0; i < 50; ++i) covered.add(-pi + 2 * pi * (i + 0.5) / 100, 100);
  EXPECT_NEAR(covered.part(), 0.5, 0.01);
  for (int i = 50; i < 100; ++i) covered.add(-pi + 2 * pi * (i + 0.5) / 100, 100);
  EXPECT_EQ(covered.part(), 1);
}

}  // namespace
}  // namespace toposcope
