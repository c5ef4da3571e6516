// SPDX-License-Identifier: BSD-3-Clause

// Repair on damage whose right answer is known, and on random soups against a brute-force check of what is promised.

#include "mesh/repair.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "base/errors.h"
#include "support/meshes.h"

namespace toposcope {
namespace {

TriangleSoup soup_of(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
  TriangleSoup soup;
  soup.positions = std::move(positions);
  soup.triangles = std::move(triangles);
  soup.input_faces = static_cast<Index>(soup.triangles.size());
  for (Index f = 0; f < soup.input_faces; ++f) soup.face_origin.push_back(f);
  return soup;
}

/// Both in one, each with its own vertices.
TriangleSoup together(const TriangleSoup& a, const TriangleSoup& b) {
  TriangleSoup soup = soup_of(a.positions, a.triangles);
  soup.positions.insert(soup.positions.end(), b.positions.begin(), b.positions.end());
  std::vector<Triangle> triangles = a.triangles;
  const auto shift = static_cast<Index>(a.positions.size());
  for (const Triangle& t : b.triangles) triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return soup_of(std::move(soup.positions), std::move(triangles));
}

TriangleSoup cube_at(const Vec3& corner) {
  TriangleSoup cube = test::make_box({1, 1, 1});
  for (Vec3& p : cube.positions) p += corner + Vec3(0.5, 0.5, 0.5);
  return cube;
}

TriangleSoup moved_together(TriangleSoup soup) {  // one vertex a place
  std::map<std::array<double, 3>, Index> number;
  std::vector<Vec3> positions;
  for (Triangle& t : soup.triangles)
    for (Index& v : t) {
      const Vec3& p = soup.positions[v];
      const auto [place, isNew] = number.try_emplace({p.x(), p.y(), p.z()}, static_cast<Index>(positions.size()));
      if (isNew) positions.push_back(p);
      v = place->second;
    }
  return soup_of(std::move(positions), std::move(soup.triangles));
}

TriangleSoup separated(const TriangleSoup& soup) {  // three vertices a face
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (const Triangle& t : soup.triangles) {
    const auto first = static_cast<Index>(positions.size());
    for (Index v : t) positions.push_back(soup.positions[v]);
    triangles.push_back({first, first + 1, first + 2});
  }
  return soup_of(std::move(positions), std::move(triangles));
}

double volume(const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles)
    sum += soup.positions[a].dot(soup.positions[b].cross(soup.positions[c])) / 6;
  return sum;
}
double area(const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles)
    sum += (soup.positions[b] - soup.positions[a]).cross(soup.positions[c] - soup.positions[a]).norm() / 2;
  return sum;
}

/// By brute force: every directed edge once, no edge of more than two faces, one fan around each vertex, every vertex
/// used.
void expect_oriented_manifold(const TriangleSoup& soup, const std::string& what) {
  std::set<std::pair<Index, Index>> directed;
  std::map<Index, std::vector<std::pair<Index, Index>>> links;  // around each vertex: from one neighbour to the next
  for (const Triangle& t : soup.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NE(t[k], t[(k + 1) % 3]) << what;
      EXPECT_TRUE(directed.emplace(t[k], t[(k + 1) % 3]).second) << what << ": an edge twice in one direction";
      links[t[k]].emplace_back(t[(k + 1) % 3], t[(k + 2) % 3]);
    }
  EXPECT_EQ(links.size(), soup.positions.size()) << what << ": a vertex without faces";
  for (const auto& [v, steps] : links) {
    std::map<Index, Index> next;
    std::set<Index> entered;
    for (const auto& [from, to] : steps) {
      next[from] = to;
      entered.insert(to);
    }
    ASSERT_EQ(next.size(), steps.size()) << what;
    Index begin = steps.front().first;
    for (const auto& [from, to] : steps)
      if (!entered.contains(from)) begin = from;
    std::size_t count = 0;
    for (Index at = begin; next.contains(at) && count < steps.size(); ++count) at = next[at];
    EXPECT_EQ(count, steps.size()) << what << ": vertex " << v << " has more than one fan";
  }
}

void expect_same(const TriangleSoup& a, const TriangleSoup& b, const std::string& what) {
  EXPECT_EQ(a.positions, b.positions) << what;
  EXPECT_EQ(a.triangles, b.triangles) << what;
  EXPECT_EQ(a.face_origin, b.face_origin) << what;
}

enum class Twice { same, same_unless_taken_apart };

RepairReport repaired(TriangleSoup& soup, const std::string& what, Twice twice = Twice::same) {
  const RepairReport report = repair(soup, what);
  expect_oriented_manifold(soup, what);
  TriangleSoup again = soup;
  repair(again, what);
  if (twice == Twice::same || !report.notable())
    expect_same(again, soup, what + " repaired twice");
  else
    expect_oriented_manifold(again, what + " repaired twice");
  return report;
}

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

TEST(Repair, SplitsCubesThatShareAnEdgeAndKeepsBothClosed) {
  TriangleSoup soup = moved_together(together(cube_at({0, 0, 0}), cube_at({1, 1, 0})));
  ASSERT_EQ(soup.positions.size(), 14U);
  const RepairReport report = repaired(soup, "two cubes at an edge");
  EXPECT_EQ(report.split_edges, 1U);
  EXPECT_EQ(report.split_vertices, 2U);
  EXPECT_EQ(report.closed_components, 2U);
  EXPECT_EQ(soup.positions.size(), 16U);
  EXPECT_NEAR(volume(soup), 2, 1e-12);
  EXPECT_TRUE(report.notable());
}

TEST(Repair, SplitsCubesThatShareAVertex) {
  TriangleSoup soup = moved_together(together(cube_at({0, 0, 0}), cube_at({1, 1, 1})));
  const RepairReport report = repaired(soup, "two cubes at a vertex");
  EXPECT_EQ(report.split_edges, 0U);
  EXPECT_EQ(report.split_vertices, 1U);
  EXPECT_EQ(report.closed_components, 2U);
}

TEST(Repair, PairsTheSheetsOfAnEdgeAroundTheirMaterial) {
  // Three wedges of 60 degrees around one edge: six faces meet there.
  std::vector<Vec3> positions = {{0, 0, 0}, {0, 0, 1}};
  std::vector<Triangle> triangles;
  for (int i = 0; i < 3; ++i) {
    const double from = 2 * pi * i / 3, to = from + pi / 3;
    const auto a = static_cast<Index>(positions.size()), b = a + 1;
    positions.emplace_back(std::cos(from), std::sin(from), 0.5);
    positions.emplace_back(std::cos(to), std::sin(to), 0.5);
    for (const Triangle& t : {Triangle{0, a, 1}, Triangle{0, 1, b}, Triangle{0, b, a}, Triangle{1, a, b}})
      triangles.push_back(t);
  }
  TriangleSoup soup = soup_of(positions, triangles);
  const RepairReport report = repaired(soup, "three wedges");
  EXPECT_EQ(report.split_edges, 1U);
  EXPECT_EQ(report.components, 3U);
  EXPECT_EQ(report.closed_components, 3U);
  EXPECT_EQ(report.turned_faces, 0U);
  EXPECT_NEAR(volume(soup), 3 * std::sqrt(3) / 12, 1e-12);
}

TEST(Repair, OpensABookAtItsBack) {
  std::vector<Vec3> positions = {{0, 0, 0}, {0, 0, 1}};
  std::vector<Triangle> triangles;
  for (int page = 0; page < 9; ++page) {
    positions.emplace_back(std::cos(0.3 * page), std::sin(0.3 * page), 0.5);
    triangles.push_back({0, 1, static_cast<Index>(page + 2)});
  }
  TriangleSoup soup = soup_of(positions, triangles);
  const RepairReport report = repaired(soup, "book");
  EXPECT_EQ(report.split_edges, 1U);
  EXPECT_EQ(soup.triangles.size(), 9U);
  EXPECT_EQ(report.closed_components, 0U);
}

TEST(Repair, CutsAMoebiusStripOpen) {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  const int n = 24;
  for (int i = 0; i < n; ++i)
    for (const double s : {-0.3, 0.0, 0.3}) {
      const double u = 2 * pi * i / n;
      positions.emplace_back((1 + s * std::cos(u / 2)) * std::cos(u), (1 + s * std::cos(u / 2)) * std::sin(u),
                             s * std::sin(u / 2));
    }
  const auto at = [&](int i, int j) { return static_cast<Index>(i < n ? 3 * i + j : 2 - j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  TriangleSoup soup = soup_of(positions, triangles);
  const RepairReport report = repaired(soup, "Moebius strip");
  EXPECT_EQ(report.cut_edges, 2U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.holes, 1U);
  EXPECT_EQ(report.euler, 1);  // a strip now, a disk
  EXPECT_EQ(soup.triangles.size(), triangles.size());
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
      const RepairReport report =
          repaired(soup, "random soup " + std::to_string(round), Twice::same_unless_taken_apart);
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
