// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/closest_face.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "support/meshes.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

// Against a fine grid over the triangle: never farther than its best point, and the weights give the point.
TEST(ClosestFace, PointOfATriangle) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 a = point(), b = point(), x = 2 * point();
    const Vec3 c = trial % 3 == 0 ? Vec3((a + b) / 2) : point();  // every third one has no area
    const TrianglePoint closest = closest_on_triangle(a, b, c, x);
    EXPECT_LT((closest.weights[0] * a + closest.weights[1] * b + closest.weights[2] * c - closest.point).norm(), 1e-12);
    for (double weight : closest.weights) EXPECT_GE(weight, 0);
    double least = 1e300;
    const int n = 60;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) least = std::min(least, ((i * a + j * b + (n - i - j) * c) / n - x).norm());
    EXPECT_LE((closest.point - x).norm(), least + 1e-12);
  }
}

TEST(ClosestFace, AgreesWithTryingAllFaces) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-4, 4);
  for (const TriangleSoup& soup : {make_torus(3, 1, 40, 16), make_box(Vec3(1, 2, 3)), make_cylinder(1, 8, 24, 1)}) {
    const ClosestFace closest(soup.positions, soup.triangles);
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 x(uniform(random), uniform(random), uniform(random));
      double least = 1e300;
      for (const Triangle& t : soup.triangles)
        least = std::min(
            least, (closest_on_triangle(soup.positions[t[0]], soup.positions[t[1]], soup.positions[t[2]], x).point - x)
                       .squaredNorm());
      EXPECT_DOUBLE_EQ(closest(x).squared_distance, least);
    }
  }
}

TEST(HalfEdges, OpposedPairsAndBoundary) {
  const Mesh mesh(make_cylinder(1, 2, 12, 3, false), "test");
  const std::vector<Index> opposite = opposite_half_edges(mesh.view());
  const auto from = [&](Index h) { return mesh.view().triangles[h / 3][h % 3]; };
  for (Index h = 0; h < opposite.size(); ++h) {
    if (opposite[h] == no_index) continue;
    EXPECT_EQ(opposite[opposite[h]], h);
    EXPECT_EQ(from(h), from(next_half_edge(opposite[h])));
  }
  EXPECT_EQ(std::count(opposite.begin(), opposite.end(), no_index), 24);
}

TEST(HalfEdges, WhatIsNoOrientedManifoldIsRefused) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, 0}};
  const auto reason = [&](std::vector<Triangle> triangles) -> std::string {
    TriangleSoup soup{corners, std::move(triangles), {}, 0};
    soup.input_faces = static_cast<Index>(soup.triangles.size());
    for (Index f = 0; f < soup.triangles.size(); ++f) soup.face_origin.push_back(f);
    try {
      opposite_half_edges(Mesh(soup, "test").view());
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(reason({{0, 1, 2}, {1, 0, 3}}), "");
  EXPECT_NE(reason({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}).find("more than two faces"), std::string::npos);
  EXPECT_NE(reason({{0, 1, 2}, {0, 1, 3}}).find("opposite orientation"), std::string::npos);
  EXPECT_NE(reason({{0, 1, 2}, {0, 3, 4}}).find("not one fan"), std::string::npos);
}

}  // namespace
