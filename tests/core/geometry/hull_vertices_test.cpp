// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/meshes.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

std::vector<Vec3> random_points(std::size_t count, std::uint64_t seed, const Vec3& spread) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (int i = 0; i < 3; ++i) p[i] = spread[i] * normal(random);
  return points;
}

/// The index of the point farthest along each of many directions.
std::vector<Index> supports(const std::vector<Vec3>& points, std::size_t directions) {
  std::vector<Index> found;
  for (const Vec3& d : random_points(directions, 99, {1, 1, 1})) {
    const auto farthest = std::max_element(points.begin(), points.end(),
                                           [&](const Vec3& p, const Vec3& q) { return d.dot(p) < d.dot(q); });
    found.push_back(static_cast<Index>(farthest - points.begin()));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

TEST(HullVertices, OfACubeFullOfPointsAreItsCorners) {
  std::vector<Vec3> points;
  std::vector<Index> corners;
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; j <= 6; ++j)
      for (int k = 0; k <= 6; ++k) {
        if (i % 6 == 0 && j % 6 == 0 && k % 6 == 0) corners.push_back(static_cast<Index>(points.size()));
        points.emplace_back(i, j, k);
      }
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    std::vector<Vec3> rotated;
    for (const Vec3& p : points) rotated.push_back(rotation * p + Vec3(7, 8, 9));
    EXPECT_EQ(hull_vertices(rotated), corners);
  }
}

TEST(HullVertices, HoldEverySupportAndNothingElse) {
  for (const Vec3& spread : {Vec3(1, 1, 1), Vec3(100, 10, 1e-3)})
    for (std::size_t count : {4U, 5U, 30U, 1000U}) {
      const std::vector<Vec3> points = random_points(count, count, spread);
      const std::vector<Index> hull = hull_vertices(points);
      EXPECT_TRUE(std::is_sorted(hull.begin(), hull.end()));
      const std::vector<Index> found = supports(points, 4000);
      EXPECT_TRUE(std::includes(hull.begin(), hull.end(), found.begin(), found.end()));
      // A direction that points away from the others finds each vertex of the hull, so all of them are extreme: the
      // hull of the hull is the hull.
      std::vector<Vec3> corners;
      for (Index v : hull) corners.push_back(points[v]);
      EXPECT_EQ(hull_vertices(corners).size(), hull.size());
    }
}

TEST(HullVertices, EveryPointOfASphere) {
  const TriangleSoup sphere = test::make_sphere(4);
  EXPECT_EQ(hull_vertices(sphere.positions).size(), sphere.positions.size());
}

TEST(HullVertices, OfFlatLinearAndSinglePoints) {
  const TriangleSoup grid = test::transformed(test::make_grid(5, 7), test::random_rotation(3), 2, {1, 2, 3});
  EXPECT_EQ(hull_vertices(grid.positions), (std::vector<Index>{0, 5, 42, 47}));
  std::vector<Vec3> line;
  for (double t : {0.5, 2.0, -1.0, 0.0}) line.push_back(t * Vec3(1, 2, 3));
  EXPECT_EQ(hull_vertices(line), (std::vector<Index>{1, 2}));
  EXPECT_EQ(hull_vertices(std::vector<Vec3>(5, Vec3(1, 2, 3))), std::vector<Index>{0});
  EXPECT_TRUE(hull_vertices({}).empty());
}

TEST(HullVertices, DoubledPointsAppearOnce) {
  std::vector<Vec3> points = test::make_box({1, 2, 3}, 1).positions;
  const std::vector<Vec3> once = points;
  points.insert(points.end(), once.begin(), once.end());
  EXPECT_EQ(hull_vertices(points).size(), 8U);
}

}  // namespace
}  // namespace toposcope
