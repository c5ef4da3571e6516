// SPDX-License-Identifier: BSD-3-Clause

// Repair on damage whose right answer is known, and on random soups against a brute-force check of what is promised.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <random>

#include "base/errors.h"
#include "repair_fixture.h"

namespace toposcope {
namespace {

using namespace test;

TEST(Repair, LeavesCleanMeshesAsTheyAre) {
  const std::pair<const char*, TriangleSoup> meshes[] = {
      {"sphere", test::make_sphere(3)},
      {"torus", test::make_torus(2, 0.5, 20, 12)},
      {"grid", test::make_grid(5, 4)},
      {"open cylinder", test::make_cylinder(1, 2, 12, 3, false)},
      {"two cubes that touch", together(cube_at({0, 0, 0}), cube_at({1, 1, 1}))},
      {"two cubes wall to wall", together(cube_at({0, 0, 0}), cube_at({1, 0.5, 0}))}};
  for (const auto& [name, mesh] : meshes) {
    TriangleSoup soup = mesh;
    EXPECT_FALSE(repaired(soup, name).changed()) << name;
    expect_same(soup, mesh, name);
  }
}

TEST(Repair, CountsTopology) {
  TriangleSoup torus = together(test::make_torus(2, 0.5, 20, 12), test::make_cylinder(1, 2, 12, 3, false));
  const RepairReport report = repaired(torus, "torus and open cylinder");
  EXPECT_EQ(report.components, 2U);
  EXPECT_EQ(report.closed_components, 1U);
  EXPECT_EQ(report.holes, 2U);
  EXPECT_EQ(report.border_edges, 24U);
  EXPECT_EQ(report.euler, 0);
  EXPECT_EQ(report.genus, 1);
}

TEST(Repair, WeldsSeparateTriangles) {
  const TriangleSoup sphere = test::make_sphere(2);
  TriangleSoup soup = separated(sphere);
  const RepairReport report = repaired(soup, "triangles");
  EXPECT_EQ(soup.positions.size(), sphere.positions.size());
  EXPECT_EQ(report.merged_vertices, 3 * sphere.triangles.size() - sphere.positions.size());
  EXPECT_EQ(report.closed_components, 1U);
  EXPECT_EQ(report.genus, 0);
  EXPECT_FALSE(report.notable());
}

TEST(Repair, TurnsFlippedFacesBack) {
  const TriangleSoup sphere = test::make_sphere(3);
  for (const double part : {0.3, 0.5, 0.9, 1.0}) {
    TriangleSoup soup = sphere;
    std::mt19937 random(4);
    std::bernoulli_distribution flip(part);
    Index flipped = 0;
    for (Triangle& t : soup.triangles)
      if (flip(random)) {
        std::swap(t[1], t[2]);
        ++flipped;
      }
    EXPECT_EQ(repaired(soup, "flipped sphere").turned_faces, flipped);
    EXPECT_EQ(soup.triangles, sphere.triangles);
  }
}

TEST(Repair, TurnsNearlyClosedSurfacesOutward) {
  TriangleSoup bowl = test::make_sphere(3);
  std::erase_if(bowl.triangles, [&](const Triangle& t) { return bowl.positions[t[0]].z() > 0.8; });
  for (Triangle& t : bowl.triangles) std::swap(t[1], t[2]);
  bowl = soup_of(bowl.positions, bowl.triangles);
  const RepairReport report = repaired(bowl, "sphere with a hole");
  EXPECT_EQ(report.turned_faces, bowl.triangles.size());
  EXPECT_GT(volume(bowl), 0);
}

TEST(Repair, KeepsOpenSurfacesAsMostOfTheirFacesAre) {
  const TriangleSoup grid = test::make_grid(6, 6);
  TriangleSoup soup = grid;
  for (std::size_t f = 0; f < 10; ++f) std::swap(soup.triangles[f][1], soup.triangles[f][2]);
  EXPECT_EQ(repaired(soup, "grid").turned_faces, 10U);
  EXPECT_EQ(soup.triangles, grid.triangles);
}

TEST(Repair, KeepsACavityAndTurnsAShellThatIsInsideOut) {
  TriangleSoup inner = test::make_sphere(2, 0.5);
  for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  TriangleSoup hollow = together(test::make_sphere(2), inner);
  EXPECT_FALSE(repaired(hollow, "hollow sphere").changed());
  TriangleSoup alone = inner;
  EXPECT_EQ(repaired(alone, "inside out").turned_faces, inner.triangles.size());
  EXPECT_GT(volume(alone), 0);
}

TEST(Repair, DropsWhatIsTwiceThereOrNotThere) {
  TriangleSoup soup = test::make_sphere(1);
  const std::size_t faces = soup.triangles.size(), vertices = soup.positions.size();
  std::vector<Triangle> triangles = soup.triangles;
  triangles.insert(triangles.begin(), {1, 1, 2});                            // a corner twice
  triangles.push_back({triangles[5][1], triangles[5][2], triangles[5][0]});  // a face again
  triangles.push_back({triangles[6][1], triangles[6][0], triangles[6][2]});  // from the other side
  soup.positions.emplace_back(9, 9, 9);                                      // of no face
  soup = soup_of(soup.positions, triangles);
  const RepairReport report = repaired(soup, "sphere with waste");
  EXPECT_EQ(report.degenerate_faces, 1U);
  EXPECT_EQ(report.duplicate_faces, 2U);
  EXPECT_EQ(report.unreferenced_vertices, 1U);
  EXPECT_EQ(soup.triangles.size(), faces);
  EXPECT_EQ(soup.positions.size(), vertices);
  for (std::size_t f = 0; f < faces; ++f) EXPECT_EQ(soup.face_origin[f], f + 1);  // faces of the input
}

TEST(Repair, JoinsNothingWhereTheSurfaceIsClosed) {
  // Two vertices far apart on a closed surface, moved to one place: welding would make an hourglass of it.
  TriangleSoup soup = test::make_sphere(2);
  const TriangleSoup sphere = soup;
  const Index other = sphere.triangles.back()[0];
  soup.positions[0] = soup.positions[other];
  const RepairReport report = repaired(soup, "sphere that touches itself");
  EXPECT_EQ(report.merged_vertices, 0U);
  EXPECT_EQ(report.closed_components, 1U);
  EXPECT_EQ(soup.triangles, sphere.triangles);
}

TEST(Repair, DropsAnObjectThatIsThereTwice) {
  const TriangleSoup sphere = test::make_sphere(2);
  TriangleSoup soup = together(sphere, sphere);
  const RepairReport report = repaired(soup, "sphere twice");
  EXPECT_EQ(report.duplicate_faces, sphere.triangles.size());
  EXPECT_EQ(report.closed_components, 1U);
  EXPECT_EQ(soup.triangles, sphere.triangles);
}

TEST(Repair, RefusesAMeshWithoutArea) {
  TriangleSoup line = soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {1, 2, 3}});
  EXPECT_THROW(repair(line, "line"), MeshError);
}

TEST(Repair, DoesNotDependOnTheOrderOfTheVertices) {
  const TriangleSoup soup =
      moved_together(together(together(cube_at({0, 0, 0}), cube_at({1, 1, 0})), cube_at({2, 2, 1})));
  TriangleSoup here = soup;
  const RepairReport expected = repair(here, "cubes");
  for (std::uint64_t seed = 1; seed < 8; ++seed) {
    std::vector<Index> renamed;
    test::shuffled(soup, seed, &renamed);
    TriangleSoup there = soup;
    for (std::size_t v = 0; v < renamed.size(); ++v) there.positions[renamed[v]] = soup.positions[v];
    for (Triangle& t : there.triangles)
      for (Index& v : t) v = renamed[v];
    const RepairReport report = repair(there, "cubes renamed");
    EXPECT_EQ(report.split_edges, expected.split_edges);
    EXPECT_EQ(report.split_vertices, expected.split_vertices);
    EXPECT_EQ(report.closed_components, expected.closed_components);
    EXPECT_EQ(there.face_origin, here.face_origin);
  }
}

TEST(Repair, DropsFacesWithoutAFiniteCorner) {
  TriangleSoup soup = test::make_grid(4, 4);
  soup.positions[12].z() = std::numeric_limits<double>::quiet_NaN();  // the middle: six faces
  const RepairReport report = repaired(soup, "grid with a NaN");
  EXPECT_EQ(report.non_finite_vertices, 1U);
  EXPECT_EQ(report.non_finite_faces, 6U);
  EXPECT_EQ(report.holes, 2U);
  for (Vec3& p : soup.positions) p.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(repair(soup, "all infinite"), MeshError);
}

TEST(Repair, FlipsCapsInsteadOfOpeningTheSurface) {
  // A square of two triangles and, on its diagonal, a cap whose middle corner lies on it: a T-junction closed by
  // nothing.
  TriangleSoup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                              {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}});
  const RepairReport report = repaired(soup, "cap");
  EXPECT_EQ(report.degenerate_faces, 1U);
  EXPECT_EQ(report.flat_faces, 0U);
  EXPECT_EQ(soup.triangles.size(), 4U);
  EXPECT_EQ(report.holes, 1U);
  EXPECT_NEAR(area(soup), 1, 1e-12);
  for (const auto& [a, b, c] : soup.triangles)
    EXPECT_GT((soup.positions[b] - soup.positions[a]).cross(soup.positions[c] - soup.positions[a]).z(), 0.1);

  TriangleSoup ear = soup_of({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}}, {{0, 3, 2}, {3, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(repaired(ear, "cap at the border").degenerate_faces, 1U);
  EXPECT_EQ(ear.triangles.size(), 2U);
}

TEST(Repair, MakesManifoldsOfAnything) {
  std::mt19937 random(11);
  for (int round = 0; round < 400; ++round) {
    const auto vertices = std::uniform_int_distribution<Index>(3, 12)(random);
    const auto faces = std::uniform_int_distribution<int>(1, 40)(random);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    std::uniform_int_distribution<Index> corner(0, vertices - 1);
    std::vector<Vec3> positions;
    for (Index v = 0; v < vertices; ++v) {
      positions.emplace_back(coordinate(random), coordinate(random), coordinate(random));
      if (v > 0 && random() % 4 == 0) positions.back() = positions[random() % v];
    }
    std::vector<Triangle> triangles;
    for (int f = 0; f < faces; ++f) triangles.push_back({corner(random), corner(random), corner(random)});
    TriangleSoup soup = soup_of(positions, triangles);
    try {
      const RepairReport report = repaired(soup, "random soup " + std::to_string(round));
      EXPECT_EQ(soup.triangles.size() + report.degenerate_faces + report.duplicate_faces, triangles.size());
      EXPECT_EQ((report.euler + report.holes) % 2, 0) << "of an oriented surface, 2 components - 2 genus";
      EXPECT_GE(report.genus, 0);
      // Each face keeps its places, whichever way it runs.
      for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
        std::multiset<double> here, there;
        for (std::size_t k = 0; k < 3; ++k) {
          here.insert(soup.positions[soup.triangles[f][k]].x());
          there.insert(positions[triangles[soup.face_origin[f]][k]].x());
        }
        EXPECT_EQ(here, there);
      }
    } catch (const MeshError&) {
      for (const auto& [a, b, c] : triangles)
        EXPECT_TRUE(positions[a] == positions[b] || positions[b] == positions[c] || positions[c] == positions[a]);
    }
  }
}

/// Three vertices a face, each moved a little.
TriangleSoup nearly_together(const TriangleSoup& mesh, double amount) {
  TriangleSoup soup = separated(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(-amount, amount);
  for (Vec3& p : soup.positions) p += Vec3(offset(random), offset(random), offset(random));
  return soup;
}

TEST(Repair, WeldsCornersThatAreNearlyAtOnePlace) {
  const TriangleSoup box = test::make_box({3, 2, 1}, 4);
  TriangleSoup soup = nearly_together(box, 1e-6);
  const RepairReport report = repaired(soup, "nearly welded");
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.closed_components, 1U);
  EXPECT_EQ(soup.triangles.size(), box.triangles.size());
  EXPECT_EQ(soup.positions.size() + report.near_vertices, 3 * box.triangles.size());
  EXPECT_LT(report.near_distance, 4e-6);
  EXPECT_TRUE(report.notable());
}

TEST(Repair, WeldsNothingWithoutAGapInTheDistances) {
  for (const double amount : {1e-3, 1e-2}) {  // of edges of 0.25 and more: no rounding
    TriangleSoup soup = nearly_together(test::make_box({3, 2, 1}, 4), amount);
    const TriangleSoup before = soup;
    EXPECT_EQ(repaired(soup, "loose").near_vertices, 0U);
    test::expect_same(soup, before, "loose");
  }
  TriangleSoup cubes = together(cube_at({0, 0, 0}), cube_at({1 + 1e-6, 0, 0}));  // closed: none of them has a seam
  EXPECT_EQ(repaired(cubes, "cubes").near_vertices, 0U);
  EXPECT_EQ(cubes.positions.size(), 16U);
}

TEST(Repair, TakesTimeInProportionToTheMesh) {
  // A hundred thousand faces at one edge, and as many at one vertex: quadratic work would not end.
  const Index n = 100000;
  std::vector<Vec3> positions = {{0, 0, 0}, {0, 0, 1}};
  std::vector<Triangle> pages, spokes;
  for (Index i = 0; i < n; ++i) {
    const double t = 2 * pi * i / n;
    positions.emplace_back(std::cos(t), std::sin(t), 0.5);
    pages.push_back({0, 1, i + 2});
    if (i % 2 == 0) spokes.push_back({0, i + 2, i + 3});
  }
  TriangleSoup book = soup_of(positions, pages), star = soup_of(positions, spokes);
  std::vector<Vec3> on_a_line;
  std::vector<Triangle> fan;
  for (Index i = 0; i < n; ++i) on_a_line.emplace_back(i, 0, 0);
  for (Index i = 2; i < n; ++i) fan.push_back({0, i - 1, i});
  TriangleSoup line = soup_of(on_a_line, fan);
  EXPECT_THROW(repair(line, "line"), MeshError);
  EXPECT_EQ(repair(book, "book").split_edges, 1U);
  EXPECT_EQ(repair(star, "star").split_vertices, n / 2 - 1);
}

}  // namespace
}  // namespace toposcope
