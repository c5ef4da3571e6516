// SPDX-License-Identifier: BSD-3-Clause
#include "sample/isosurface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/run_context.h"
#include "sample/lifting_surface.h"

namespace toposcope {
namespace {

TriangleSoup net(const Implicit& surface, double reach, double spacing, double level = 0) {
  RunContext context({.threads = 2});
  return extract_isosurface(surface, Vec3::Constant(-reach), Vec3::Constant(reach), spacing, level, context);
}

double volume(const TriangleSoup& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles)
    six += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]]));
  return six / 6;
}

TEST(Isosurface, BallIsClosedLooksOutwardsAndHasItsVolume) {
  const Implicit ball = [](const Vec3& p) -> Distance { return {p.norm() - 3, p.normalized()}; };
  const TriangleSoup mesh = net(ball, 3, 0.2);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_NEAR(volume(mesh), 4.0 / 3 * pi * 27, 0.5);
  for (const Vec3& p : mesh.positions) EXPECT_NEAR(p.norm(), 3, 1e-12);
}

TEST(Isosurface, SkippedCubesChangeNothing) {
  // A function too steep to skip anything by has the same zero set, so every node is sampled; the net must be the same
  // but for the vertices' last digits.
  const Implicit ball = [](const Vec3& p) -> Distance { return {p.norm() - 3, p.normalized()}; };
  const Implicit flat = [ball](const Vec3& p) -> Distance {
    const Distance d = ball(p);
    return {0.01 * d.value, 0.01 * d.gradient};
  };
  const TriangleSoup skipping = net(ball, 3, 0.17), whole = net(flat, 3, 0.17);
  ASSERT_EQ(skipping.triangles.size(), whole.triangles.size());
  ASSERT_EQ(skipping.positions.size(), whole.positions.size());
  for (std::size_t v = 0; v < whole.positions.size(); ++v)
    EXPECT_LT((skipping.positions[v] - whole.positions[v]).norm(), 1e-3);
}

TEST(Isosurface, SlightRidgesThatCrossTheGridsPlanesStayManifold) {
  // A slack roof on a half ball, its ridge at 45 degrees to the grid, lifted in small steps through a plane of nodes.
  for (int i = 0; i < 40; ++i) {
    const double top = 0.005 * i;
    const Implicit roof = [top](const Vec3& p) -> Distance {
      const double across = (p.x() - p.y()) * std::sqrt(0.5), slope = 0.03;
      const Vec3 n =
          Vec3(std::copysign(std::sqrt(0.5), across) * slope, -std::copysign(std::sqrt(0.5), across) * slope, 1);
      const double under = (p.z() - top + slope * std::abs(across)) / n.norm(), ball = p.norm() - 3;
      return under > ball ? Distance{under, n.normalized()} : Distance{ball, p.normalized()};
    };
    EXPECT_TRUE(is_closed_manifold(net(roof, 3, 0.2))) << top;
  }
}

TEST(Isosurface, EdgesThinnerThanACellComeOutWhole) {
  Planform p;
  p.origin = Vec3(4, -5, 0);
  p.span = 10;
  p.root_chord = p.tip_chord = 8;
  p.thickness = 0.2;
  p.trailing = 0.2;  // the trailing edge is 0.32 thick, a cell 0.5 wide
  const LiftingSurface wing(p);
  const Implicit surface = wing;
  const TriangleSoup mesh = net(surface, 6, 0.5, 0.4);
  EXPECT_TRUE(is_closed_manifold(mesh));
  const auto nearest = [&](const Vec3& q) {
    double least = 1e9;
    for (const Vec3& v : mesh.positions) least = std::min(least, (v - q).norm());
    return least;
  };
  for (const auto& piece : wing.outline()) EXPECT_LT(nearest(0.5 * (piece.from + piece.to)), 0.5);
  for (const Vec3& v : mesh.positions) EXPECT_NEAR(surface(v).value, 0, 1e-9);
}

}  // namespace
}  // namespace toposcope
