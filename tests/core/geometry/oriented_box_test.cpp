// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "support/meshes.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

double volume(const Box& box) {
  return box.a() * box.b() * box.c();
}

void expect_sound(const Box& box, const std::vector<Vec3>& points) {
  EXPECT_GE(box.a(), box.b());
  EXPECT_GE(box.b(), box.c());
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.axes[i].norm(), 1, 1e-12);
    EXPECT_NEAR(box.axes[i].dot(box.axes[(i + 1) % 3]), 0, 1e-12);
  }
  EXPECT_NEAR(box.axes[0].cross(box.axes[1]).dot(box.axes[2]), 1, 1e-12);
  for (int i = 0; i < 3; ++i) {
    double reach = 0;
    for (const Vec3& p : points) reach = std::max(reach, std::abs(box.axes[i].dot(p - box.center)));
    EXPECT_NEAR(reach, box.sides[i] / 2, 1e-9 * box.a()) << "side " << i << " touches the points";
  }
}

/// The sides after any motion, scaling and reordering are the same up to rounding.
void expect_invariant(const TriangleSoup& soup, double tolerance) {
  const Box box = oriented_box(soup.positions);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const double scale = std::pow(10.0, static_cast<double>(seed) - 5);
    const TriangleSoup moved =
        test::shuffled(test::transformed(soup, test::random_rotation(seed), scale, scale * Vec3(4, -5, 6)), seed);
    const Box other = oriented_box(moved.positions);
    expect_sound(other, moved.positions);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(other.sides[i] / scale, box.sides[i], tolerance * box.a());
  }
}

std::vector<Vec3> random_points(std::size_t count, int kind, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p(normal(random), normal(random), normal(random));
    if (kind == 0) points.push_back(p);
    if (kind == 1) points.push_back(p.normalized().cwiseProduct(Vec3(3, 1, 0.5)));
    if (kind == 2) points.emplace_back(10 * p.x(), 3 * p.y(), 0.1 * p.z() + p.x() * p.x());
  }
  return points;
}

/// Least volume over thousands of rotations, the best of them refined by ever smaller random turns.
double searched_volume(const std::vector<Vec3>& all) {
  std::vector<Vec3> points;
  for (Index v : hull_vertices(all)) points.push_back(all[v]);
  const auto volume_in = [&](const Eigen::Matrix3d& rotation) {
    Vec3 low = rotation * points[0], high = low;
    for (const Vec3& p : points) {
      low = low.cwiseMin(rotation * p);
      high = high.cwiseMax(rotation * p);
    }
    return (high - low).prod();
  };
  std::vector<std::pair<double, Eigen::Matrix3d>> frames;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    frames.emplace_back(volume_in(rotation), rotation);
  }
  std::sort(frames.begin(), frames.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double best = frames[0].first;
  for (std::size_t i = 0; i < 8; ++i) {
    auto [least, rotation] = frames[i];
    for (double step = 0.2; step > 1e-4; step *= 0.99) {
      const Vec3 turn(step * normal(random), step * normal(random), step * normal(random));
      const Eigen::Matrix3d turned = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * rotation;
      if (const double v = volume_in(turned); v < least) {
        least = v;
        rotation = turned;
      }
    }
    best = std::min(best, least);
  }
  return best;
}

TEST(OrientedBox, OfCuboidsInAnyPose) {
  const Vec3 sides(5, 2, 0.7);
  const TriangleSoup cuboid = test::make_box(sides, 6);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    const TriangleSoup moved = test::shuffled(test::transformed(cuboid, rotation, 3, {10, 20, 30}), seed);
    const Box box = oriented_box(moved.positions);
    expect_sound(box, moved.positions);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(box.sides[i], 3 * sides[i], 1e-12 * 15);
      EXPECT_NEAR(std::abs(box.axes[i].dot(rotation.col(i))), 1, 1e-12);
    }
    EXPECT_NEAR((box.center - Vec3(10, 20, 30)).norm(), 0, 1e-11);
  }
}

// The sides' points lie in line but for rounding, in any order along them.
TEST(OrientedBox, OfRectanglesInAnyPose) {
  std::mt19937_64 random(5);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::size_t columns = 1 + random() % 6, rows = 1 + random() % 6;
    const double width = 1 + static_cast<double>(random() % 100), height = 1 + static_cast<double>(random() % 100);
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i <= columns; ++i)
      for (std::size_t j = 0; j <= rows; ++j)
        points.emplace_back(rotation * Vec3(width * static_cast<double>(i) / static_cast<double>(columns),
                                            height * static_cast<double>(j) / static_cast<double>(rows), 0));
    const Box box = oriented_box(points);
    EXPECT_NEAR(box.a(), std::max(width, height), 1e-11) << seed;
    EXPECT_NEAR(box.b(), std::min(width, height), 1e-11) << seed;
  }
}

TEST(OrientedBox, WithinOnePercentOfASearchOverRotations) {
  for (int kind = 0; kind < 3; ++kind)
    for (std::size_t count : {12U, 60U, 400U}) {
      const std::vector<Vec3> points = random_points(count, kind, count + 7);
      const Box box = oriented_box(points);
      expect_sound(box, points);
      EXPECT_LE(volume(box), 1.01 * searched_volume(points)) << "kind " << kind << ", " << count << " points";
    }
}

TEST(OrientedBox, SidesDoNotDependOnThePose) {
  expect_invariant(test::make_box({3, 2, 1}, 8), 1e-12);
  expect_invariant(test::make_box({1, 1, 1}, 8), 1e-12);
  expect_invariant(test::make_cylinder(1, 3, 48, 20), 1e-9);
  expect_invariant(test::make_cylinder(3, 1, 50, 5), 1e-9);
  expect_invariant(test::make_grid(20, 30, 2, 3), 1e-12);
  // On a sphere every frame is as good as any other: only about the same sides come out.
  expect_invariant(test::make_sphere(3), 5e-3);
  expect_invariant(test::make_torus(2, 0.5, 64, 32), 5e-3);
  for (int kind = 0; kind < 3; ++kind) {
    TriangleSoup cloud;
    cloud.positions = random_points(300, kind, 5);
    expect_invariant(cloud, 1e-9);
  }
}

TEST(OrientedBox, OfRoundBodies) {
  const Box sphere = oriented_box(test::make_sphere(5, 2).positions);
  for (double side : sphere.sides) EXPECT_NEAR(side, 4, 4e-3);
  const Box cylinder = oriented_box(test::make_cylinder(1, 3, 400, 40).positions);
  EXPECT_NEAR(cylinder.a(), 3, 1e-9);
  EXPECT_NEAR(cylinder.b(), 2, 1e-3);
  EXPECT_NEAR(cylinder.c(), 2, 1e-3);
}

TEST(OrientedBox, FlatSetsHaveNoThickness) {
  const TriangleSoup grid = test::make_grid(10, 10, 3, 2);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleSoup moved = test::transformed(grid, test::random_rotation(seed), 2, {1, 2, 3});
    const Box box = oriented_box(moved.positions);
    expect_sound(box, moved.positions);
    EXPECT_NEAR(box.a(), 6, 1e-12);
    EXPECT_NEAR(box.b(), 4, 1e-12);
    EXPECT_EQ(box.c(), 0);
  }
  // A diamond: its principal axes are the diagonals, its least rectangle is not along them.
  const Box diamond = oriented_box(std::vector<Vec3>{{2, 0, 1}, {0, 1, 1}, {-2, 0, 1}, {0, -1, 1}});
  EXPECT_NEAR(diamond.a() * diamond.b(), 6.4, 1e-12);
  EXPECT_EQ(diamond.c(), 0);
}

TEST(OrientedBox, LinearSetsAndSinglePoints) {
  std::vector<Vec3> line;
  for (int i = 0; i < 30; ++i) line.push_back(Vec3(1, 2, 3) + i * Vec3(1, -2, 2));
  const Box box = oriented_box(line);
  EXPECT_NEAR(box.a(), 29 * 3, 1e-12);
  EXPECT_EQ(box.b(), 0);
  EXPECT_EQ(box.c(), 0);
  EXPECT_NEAR(std::abs(box.axes[0].dot(Vec3(1, -2, 2) / 3)), 1, 1e-12);
  for (std::size_t count : {1U, 2U, 200U}) {
    const Box point = oriented_box(std::vector<Vec3>(count, Vec3(1, 2, 3)));
    EXPECT_EQ(point.a(), 0);
    EXPECT_EQ(point.center, Vec3(1, 2, 3));
  }
  EXPECT_EQ(oriented_box({}).a(), 0);
}

TEST(OrientedBox, ThinSetsKeepTheirThickness) {
  const TriangleSoup plate =
      test::transformed(test::make_box({1, 0.6, 1e-6}, 5), test::random_rotation(1), 1, {1, 1, 1});
  const Box box = oriented_box(plate.positions);
  EXPECT_NEAR(box.c(), 1e-6, 1e-12);
  EXPECT_NEAR(box.b(), 0.6, 1e-9);
}

TEST(OrientedBox, IsTheSameOnEveryRun) {
  const std::vector<Vec3> points = random_points(3000, 2, 4);
  const Box first = oriented_box(points), second = oriented_box(points);
  EXPECT_EQ(first.sides, second.sides);
  EXPECT_EQ(first.center, second.center);
}

/// Found by fuzzing: three points span a plane, but rounding gave them a thickness.
TEST(OrientedBox, ThreePointsOfVeryUnequalDistancesAreFlat) {
  for (const std::vector<Vec3>& points :
       {std::vector<Vec3>{
            {0, 0, 0}, {0, 0, 1}, {3.7297581911843736e-08, 9.3250607235972893e-09, 8.6245917664075538e-33}},
        {{4.1578954386741888e+21, 38882762555392, 3397.141845703125},
         {1.5003184815576021e-19, 5.4272936229725068e-31, 4.544945134045912e+30},
         {2.1039985115139816e-19, 5.2278288877674983e+22, 2.5193109820520476e-09}},
        {{5, 0, 1}, {1, 1, 0}, {0, 1, 77777550.5}}}) {
    const Box box = oriented_box(points);
    double longest = 0;
    for (const Vec3& p : points)
      for (const Vec3& q : points) longest = std::max(longest, (p - q).norm());
    EXPECT_NEAR(box.a(), longest, 1e-6 * longest);
    EXPECT_LT(box.c(), 1e-8 * longest);
  }
}

}  // namespace
}  // namespace toposcope
