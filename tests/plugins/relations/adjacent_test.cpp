// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"
#include "support/random.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

/// A patch of n x n points, 0.1 apart, with its corner at a point.
Feature patch(const Vec3& corner, int n = 12, const Vec3& u = Vec3::UnitX(), const Vec3& v = Vec3::UnitY()) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) points.push_back(corner + 0.1 * i * u + 0.1 * j * v);
  return points_feature(points);
}
RelationResult adjacent(const Feature& first, const Feature& second, const Motion& motion = {}) {
  return relate(*test::relation("adjacent"), first, second, motion);
}

TEST(Adjacent, NeighboursAnEdgeApartTouch) {
  EXPECT_EQ(adjacent(patch({0, 0, 0}), patch({1.2, 0, 0})).residual, 0) << "one edge on";
  EXPECT_NEAR(adjacent(patch({0, 0, 0}), patch({1.25, 0, 0})).residual, 0, 1e-12) << "one edge and a half";
  EXPECT_NEAR(adjacent(patch({0, 0, 0}), patch({1.4, 0, 0})).residual, 0.15, 1e-12) << "three edges";
  EXPECT_NEAR(adjacent(patch({0, 0, 0}), patch({1.1, 0, 0.1}, 8, Vec3::UnitY(), Vec3::UnitZ())).residual, 0, 1e-12);
}

TEST(Adjacent, DistanceIsThatOfTheNearestPointsByBruteForce) {
  test::Random random(5);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Vec3> points[2];
    const double apart = random.uniform(0, 2);
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < 30 + 170 * side; ++i)
        points[side].emplace_back(random.normal() + side * apart, random.normal(), random.normal());
    double least = 1e300;
    for (const Vec3& p : points[0])
      for (const Vec3& q : points[1]) least = std::min(least, (p - q).norm());
    EXPECT_NEAR(adjacent(points_feature(points[0]), points_feature(points[1])).residual, std::max(0.0, least - 0.15),
                1e-12);
  }
}

TEST(Adjacent, FarFeaturesAreFarWithoutASearch) {
  const RelationResult result = adjacent(patch({0, 0, 0}, 3), patch({3, 0, 0}, 3));
  EXPECT_GT(result.residual, 10 * result.tolerance);
  EXPECT_LT(result.residual, 2.8 - 0.15 + 1e-12) << "never more than the distance";
}

TEST(Adjacent, SaysWhatTheKernelNeeds) {
  const RelationResult result = adjacent(patch({0, 0, 0}), patch({1.2, 0, 0}));
  EXPECT_NEAR(result.tolerance, 0.15, 1e-12);
  EXPECT_NEAR(result.slack, 0.15, 1e-12);
  EXPECT_EQ(result.sd, 0);
  EXPECT_EQ(result.dof, 1);
  EXPECT_NEAR(result.clutter_density, 2 / std::sqrt(29.0), 1e-12);
}

TEST(Adjacent, PoseScaleAndOrderDoNotMatter) {
  expect_invariant(*test::relation("adjacent"), patch({0, 0, 0}), patch({1.43, 0.2, 0.3}, 7), 1);
  expect_invariant(*test::relation("adjacent"), patch({0, 0, 0}, 3), patch({3, 0.2, 0.3}, 4), 1);
}

TEST(Adjacent, OutlineStandsForMissingPoints) {
  Feature outline = circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1);
  EXPECT_FALSE(adjacent(outline, patch({1.4, 0, 0})).applicable) << "neither points nor outline";
  for (int i = 0; i < 64; ++i) outline.shape.outline.emplace_back(std::cos(i * pi / 32), std::sin(i * pi / 32), 0);
  EXPECT_NEAR(adjacent(outline, patch({1.4, 0, 0})).residual, 0.25, 1e-12);
}

}  // namespace
