// SPDX-License-Identifier: BSD-3-Clause
#include "sample/depth_fusion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/run_context.h"
#include "sample/scan_parts.h"
#include "sample/well_composed.h"
#include "support/meshes.h"
#include "support/random.h"
#include "toposcope/geometry/closest_face.h"
#include "toposcope/geometry/spread_directions.h"

namespace toposcope {
namespace {

struct Fused {
  TriangleSoup mesh;
  std::vector<DepthView> views;
};

/// Scans a mesh about the origin on a grid of the given spacing.
Fused fuse(const TriangleSoup& object, const std::vector<Vec3>& directions, double spacing, double noise = 0,
           double level = 0, std::uint64_t seed = 1, unsigned threads = 2) {
  RunContext context({.threads = threads});
  Vec3 low = Vec3::Constant(1e300), high = -low;
  double radius = 0;
  for (const Vec3& p : object.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    radius = std::max(radius, p.norm());
  }
  Fused fused;
  fused.views = scan_depths(object, directions,
                            {.pixel = spacing / 2, .distance = 3 * radius, .noise = noise, .seed = seed}, context);
  fused.mesh = fuse_depths(fused.views, {.spacing = spacing, .level = level, .noise = noise}, low, high, context);
  return fused;
}

double volume(const TriangleSoup& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles)
    six += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]]));
  return six / 6;
}

long euler(const TriangleSoup& mesh) {
  return static_cast<long>(mesh.positions.size()) - static_cast<long>(mesh.triangles.size() / 2);
}

/// Turned, so that no face lies along the grid.
TriangleSoup turned(const TriangleSoup& mesh) {
  return test::transformed(mesh, Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(), 1,
                           Vec3::Zero());
}

TEST(SpreadDirections, AreUnitVectorsFarFromEachOtherAndEven) {
  for (const std::size_t count : {1U, 6U, 60U}) {
    const std::vector<Vec3> directions = spread_directions(count);
    ASSERT_EQ(directions.size(), count);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(directions[i].norm(), 1, 1e-12);
      sum += directions[i];
      // A cap of angle a about each covers the sphere once where 2 (1 - cos a) pi count = 4 pi.
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_LT(directions[i].dot(directions[k]), 1 - 2 / static_cast<double>(count) * 0.6);
    }
    if (count > 1) {
      EXPECT_LT(sum.norm() / static_cast<double>(count), 0.1);
    }
  }
}

TEST(ScanDepths, SeeTheSphereWhereTheRayMeetsIt) {
  RunContext context({.threads = 1});
  const TriangleSoup sphere = test::make_sphere(6);
  const std::vector<DepthView> views =
      scan_depths(sphere, {Vec3(1, 2, 2)}, {.pixel = 0.02, .distance = 3, .noise = 0}, context);
  ASSERT_EQ(views.size(), 1U);
  const DepthView& view = views.front();
  EXPECT_LT((view.viewpoint - Vec3(1, 2, 2)).norm(), 1e-12);
  int measured = 0, hit = 0;
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const DepthCell& cell = view.cells[y * view.width + x];
      if (cell.w > 0) ++hit;
      if (cell.weight == 0) continue;
      ++measured;
      const double u = (x + 0.5 - view.center_x) / view.focal, v = (y + 0.5 - view.center_y) / view.focal;
      const Vec3 ray = view.axes.transpose() * Vec3(u, v, 1);
      const Vec3 point = view.viewpoint + ray / static_cast<double>(cell.w + (cell.wx + cell.wy + cell.wxy / 2) / 2);
      const double cosine = -ray.normalized().dot(point.normalized());
      EXPECT_NEAR(cell.weight, cosine, 0.05);
      EXPECT_GT(cosine, std::cos(77 * pi / 180));
    }
  // The disk seen within 75 degrees of the normal, of the cap of which the viewpoint sees all.
  EXPECT_GT(measured, 0.8 * hit);
  EXPECT_GT(measured, 5000);
}

TEST(ScanDepths, NoiseHasTheAskedSizeAlongTheRay) {
  RunContext context({.threads = 1});
  const TriangleSoup sphere = test::make_sphere(5);
  const DepthScanner exact{.pixel = 0.01, .distance = 3, .noise = 0},
      noisy{.pixel = 0.01, .distance = 3, .noise = 0.004};
  const DepthView a = scan_depths(sphere, {Vec3(0, 0, 1)}, exact, context).front();
  const DepthView b = scan_depths(sphere, {Vec3(0, 0, 1)}, noisy, context).front();
  double sum = 0, squares = 0, count = 0;
  for (std::uint32_t y = 0; y < a.height; ++y)
    for (std::uint32_t x = 0; x < a.width; ++x) {
      const DepthCell &p = a.cells[y * a.width + x], &q = b.cells[y * a.width + x];
      if (p.weight == 0 || q.weight == 0) continue;
      const double u = (x - a.center_x) / a.focal, v = (y - a.center_y) / a.focal;
      const double along = (1 / static_cast<double>(q.w) - 1 / static_cast<double>(p.w)) * std::sqrt(1 + u * u + v * v);
      sum += along;
      squares += along * along;
      ++count;
    }
  ASSERT_GT(count, 20000);
  EXPECT_NEAR(sum / count, 0, 4 * 0.004 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.004, 0.02 * 0.004);
}

TEST(FuseDepths, WithoutNoiseTheSphereComesBack) {
  const Fused fused = fuse(test::make_sphere(6), spread_directions(60), 0.05);
  ASSERT_TRUE(is_closed_manifold(fused.mesh));
  EXPECT_EQ(euler(fused.mesh), 2);
  for (const Vec3& p : fused.mesh.positions) EXPECT_NEAR(p.norm(), 1, 0.002) << "a 25th of the spacing";
}

TEST(FuseDepths, NoiseLeavesTheMeanRadius) {
  for (const double noise : {0.002, 0.01}) {
    const Fused fused = fuse(test::make_sphere(6), spread_directions(60), 0.05, noise);
    ASSERT_TRUE(is_closed_manifold(fused.mesh));
    double sum = 0, squares = 0;
    for (const Vec3& p : fused.mesh.positions) {
      sum += p.norm() - 1;
      squares += (p.norm() - 1) * (p.norm() - 1);
    }
    const auto count = static_cast<double>(fused.mesh.positions.size());
    EXPECT_LT(std::abs(sum / count), 0.1 * noise + 0.001);
    // About 20 views see a point; a pixel's noise is averaged over them and over four pixels at best.
    EXPECT_LT(std::sqrt(squares / count), 0.4 * noise + 0.001);
  }
}

TEST(FuseDepths, EdgesOfABoxStaySharp) {
  const TriangleSoup box = turned(test::make_box(Vec3(1.6, 1, 0.7), 8));
  const double spacing = 0.05;
  const Fused fused = fuse(box, spread_directions(60), spacing);
  ASSERT_TRUE(is_closed_manifold(fused.mesh));
  EXPECT_EQ(euler(fused.mesh), 2);
  EXPECT_NEAR(volume(fused.mesh), 1.6 * 1 * 0.7, 0.005 * 1.12);
  const ClosestFace exact(box.positions, box.triangles), made(fused.mesh.positions, fused.mesh.triangles);
  for (const Vec3& p : fused.mesh.positions) EXPECT_LT(exact(p).squared_distance, std::pow(0.5 * spacing, 2));
  for (const Vec3& p : box.positions) EXPECT_LT(made(p).squared_distance, std::pow(spacing, 2));
}

TEST(FuseDepths, ThinPlatesSurvive) {
  // 2 % of its length thick, and with the net laid outside it a quarter of that.
  for (const auto& [thickness, level] : {std::pair(0.04, 0.0), std::pair(0.01, 0.015)}) {
    const TriangleSoup plate = turned(test::make_box(Vec3(2, 1, thickness), 40));
    const Fused fused = fuse(plate, spread_directions(60), 0.02, 0.0005, level);
    ASSERT_TRUE(is_closed_manifold(fused.mesh));
    EXPECT_EQ(euler(fused.mesh), 2) << thickness;
    EXPECT_NEAR(volume(fused.mesh), 2 * thickness, 0.1 * 2 * thickness);
  }
}

TEST(FuseDepths, WhatNoViewSeesIsClosed) {
  // From above and from the sides: what lies under the sphere stays a part of it.
  std::vector<Vec3> above = spread_directions(60);
  std::erase_if(above, [](const Vec3& d) { return d.z() < 0.3; });
  Fused fused = fuse(test::make_sphere(5), above, 0.06);
  keep_large_components(fused.mesh, true);
  ASSERT_TRUE(is_closed_manifold(fused.mesh));
  EXPECT_GT(volume(fused.mesh), 1.02 * 4 / 3 * pi);
  const std::size_t closed = fused.mesh.triangles.size();
  RunContext context({.threads = 2});
  keep_measured(fused.mesh, fused.views, 0.06, context);
  EXPECT_LT(fused.mesh.triangles.size(), closed);
  EXPECT_FALSE(is_closed_manifold(fused.mesh));
  for (const Vec3& p : fused.mesh.positions) EXPECT_NEAR(p.norm(), 1, 0.06);
}

TEST(FuseDepths, IsClosedUnderHeavyNoise) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Fused fused = fuse(test::make_torus(1, 0.35, 96, 48), spread_directions(30), 0.06, 0.06, 0, seed);
    EXPECT_FALSE(fused.mesh.triangles.empty());
    EXPECT_TRUE(is_closed_manifold(fused.mesh)) << seed;
  }
}

TEST(FuseDepths, IsTheSameAtAnyThreadCount) {
  const TriangleSoup torus = test::make_torus(1, 0.35, 96, 48);
  const Fused one = fuse(torus, spread_directions(24), 0.05, 0.003, 0.01, 7, 1);
  const Fused two = fuse(torus, spread_directions(24), 0.05, 0.003, 0.01, 7, 2);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.mesh.positions, two.mesh.positions);
  const Fused other = fuse(torus, spread_directions(24), 0.05, 0.003, 0.01, 8);
  EXPECT_NE(one.mesh.positions, other.mesh.positions);
}

TEST(MakeWellComposed, MakesAManifoldOfAnyNodes) {
  test::Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    NodeGrid grid = make_node_grid(Vec3::Zero(), Vec3::Constant(12), 1);
    for (float& value : grid.values) value = 1;
    for (std::size_t z = 3; z < 13; ++z)
      for (std::size_t y = 3; y < 13; ++y)
        for (std::size_t x = 3; x < 13; ++x)
          grid.values[grid.node(x, y, z)] = static_cast<float>(random.uniform(-1, 1));
    const std::vector<float> before = grid.values;
    const auto net = [&] { return surface_net(grid, [](std::vector<Vec3>&) { return std::vector<Vec3>(); }); };
    EXPECT_FALSE(is_closed_manifold(net()));
    make_well_composed(grid);
    EXPECT_TRUE(is_closed_manifold(net()));
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i] < 0) {
        EXPECT_LT(grid.values[i], 0) << "nodes are filled in only";
      }
  }
}

}  // namespace
}  // namespace toposcope
