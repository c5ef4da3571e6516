// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/errors.h"
#include "support/meshes.h"

namespace toposcope {
namespace {

TriangleSoup soup(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
  TriangleSoup result{std::move(positions), std::move(triangles), {}, 0};
  for (Index f = 0; f < result.triangles.size(); ++f) result.face_origin.push_back(f);
  result.input_faces = static_cast<Index>(result.triangles.size());
  return result;
}

const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::string error_of(TriangleSoup input) {
  try {
    const Mesh mesh(std::move(input), "part.ply");
  } catch (const MeshError& error) {
    EXPECT_EQ(error.exit_code, 3);
    return error.what();
  }
  return "";
}

TEST(Mesh, AdjacencyIsThatOfBruteForce) {
  for (const TriangleSoup& input :
       {test::make_sphere(2), test::make_torus(2, 1, 7, 5), test::shuffled(test::make_grid(4, 3), 1),
        soup(square, {{0, 1, 2}, {2, 1, 0}, {0, 2, 3}})}) {
    const Mesh mesh(input, "mesh");
    const MeshView& view = mesh.view();
    ASSERT_EQ(view.vertex_count(), input.positions.size());
    for (Index v = 0; v < view.vertex_count(); ++v) {
      std::set<Index> neighbors, faces;
      for (Index f = 0; f < input.triangles.size(); ++f)
        for (Index corner : input.triangles[f])
          if (corner == v) {
            faces.insert(f);
            neighbors.insert(input.triangles[f].begin(), input.triangles[f].end());
          }
      neighbors.erase(v);
      EXPECT_TRUE(std::ranges::equal(view.one_ring(v), neighbors));
      EXPECT_TRUE(std::ranges::equal(view.faces_of(v), faces));
    }
  }
}

TEST(Mesh, SatisfiesEuler) {
  const auto characteristic = [](const TriangleSoup& input) {
    const Mesh mesh(input, "mesh");
    const MeshView& view = mesh.view();
    return static_cast<int>(view.vertex_count()) - static_cast<int>(view.neighbors.size() / 2) +
           static_cast<int>(view.face_count());
  };
  EXPECT_EQ(characteristic(test::make_sphere(3)), 2);
  EXPECT_EQ(characteristic(test::make_box({1, 2, 3}, 4)), 2);
  EXPECT_EQ(characteristic(test::make_cylinder(1, 2, 12, 3)), 2);
  EXPECT_EQ(characteristic(test::make_cylinder(1, 2, 12, 3, false)), 0);
  EXPECT_EQ(characteristic(test::make_torus(3, 1, 12, 8)), 0);
  EXPECT_EQ(characteristic(test::make_grid(3, 4)), 1);
}

TEST(Mesh, MeanEdgeIsOverUndirectedEdges) {
  const Mesh mesh(soup(square, {{0, 1, 2}, {0, 2, 3}}), "mesh");
  EXPECT_NEAR(mesh.view().mean_edge, (4 + std::sqrt(2.0)) / 5, 1e-15) << "the diagonal counts once";
}

TEST(Mesh, DropsFacesThatRepeatAVertexAndKeepsOrigins) {
  TriangleSoup input = soup(square, {{0, 0, 1}, {0, 1, 2}, {3, 1, 3}, {0, 2, 3}});
  input.face_origin = {4, 3, 2, 1};
  input.input_faces = 5;
  const Mesh mesh(std::move(input), "mesh");
  EXPECT_EQ(mesh.view().face_count(), 2U);
  EXPECT_TRUE(std::ranges::equal(mesh.face_origin(), std::vector<Index>{3, 1}));
  EXPECT_EQ(mesh.input_faces(), 5U);
}

TEST(Mesh, VerticesWithoutFacesStayButDoNotCountForTheBox) {
  std::vector<Vec3> positions = square;
  positions.emplace_back(100, 100, 100);
  const Mesh mesh(soup(positions, {{0, 1, 2}, {0, 2, 3}}), "mesh");
  EXPECT_EQ(mesh.view().vertex_count(), 5U);
  EXPECT_TRUE(mesh.view().one_ring(4).empty());
  EXPECT_TRUE(mesh.view().faces_of(4).empty());
  EXPECT_NEAR(mesh.view().box.a(), 1, 1e-12);
}

TEST(Mesh, ViewSurvivesAMove) {
  Mesh first(test::make_sphere(1), "mesh");
  const std::vector<Index> ring(first.view().one_ring(5).begin(), first.view().one_ring(5).end());
  const Mesh second(std::move(first));
  EXPECT_TRUE(std::ranges::equal(second.view().one_ring(5), ring));
  EXPECT_EQ(second.view().positions[5].norm(), 1);
}

TEST(Mesh, MeasuresFollowMotionScaleAndOrder) {
  const TriangleSoup torus = test::make_torus(2, 0.7, 40, 20);
  const Mesh mesh(torus, "mesh");
  const Mesh moved(test::shuffled(test::transformed(torus, test::random_rotation(4), 1e-3, {1, 2, 3}), 9), "mesh");
  EXPECT_NEAR(moved.view().mean_edge * 1e3, mesh.view().mean_edge, 1e-12);
  EXPECT_NEAR(moved.view().box.c() * 1e3, mesh.view().box.c(), 1e-9);
}

TEST(Mesh, RefusesWhatIsNoMesh) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_NE(error_of({}).find("part.ply: no vertex"), std::string::npos);
  EXPECT_NE(error_of(soup(square, {})).find("no face"), std::string::npos);
  EXPECT_NE(error_of(soup(square, {{0, 1, 4}})).find("vertex 4"), std::string::npos);
  EXPECT_NE(error_of(soup({{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}, {{0, 1, 2}})).find("vertex 1"), std::string::npos);
  EXPECT_NE(error_of(soup({{0, 0, 0}, {1, 0, 0}, {0, infinity, 0}}, {{0, 1, 2}})).find("vertex 2"), std::string::npos);
  EXPECT_NE(error_of(soup(square, {{0, 0, 1}, {2, 2, 2}})).find("repeats a vertex"), std::string::npos);
  EXPECT_NE(error_of(soup(std::vector<Vec3>(3, Vec3(1, 1, 1)), {{0, 1, 2}})).find("no extent"), std::string::npos);
  EXPECT_NE(error_of(soup({{0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}}, {{0, 1, 2}})).find("rescale"), std::string::npos);
  EXPECT_NE(error_of(soup({{0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}}, {{0, 1, 2}})).find("rescale"),
            std::string::npos);
  TriangleSoup without_origin = soup(square, {{0, 1, 2}});
  without_origin.face_origin.clear();
  EXPECT_NE(error_of(without_origin).find("face origins"), std::string::npos);
}

}  // namespace
}  // namespace toposcope
