// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/run_context.h"
#include "mesh/mesh.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "toposcope/filters.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

struct Caught final : MeshSink {
  void set(std::span<const Vec3> p, std::span<const Triangle> t, std::span<const Index> o,
           std::span<const Index> vertex_origin) override {
    called = true;
    mesh.positions.assign(p.begin(), p.end());
    mesh.triangles.assign(t.begin(), t.end());
    mesh.face_origin.assign(o.begin(), o.end());
    mesh.input_vertices.assign(vertex_origin.begin(), vertex_origin.end());
  }
  bool called = false;
  TriangleSoup mesh;
};

Caught refined(const TriangleSoup& soup, const Settings& settings, Context& context = test::context()) {
  const Mesh mesh(soup, "test");
  Caught caught;
  test::filter("refine", settings)->apply(mesh.view(), context, caught);
  return caught;
}

double face_area(const TriangleSoup& s, const Triangle& t) {
  return (s.positions[t[1]] - s.positions[t[0]]).cross(s.positions[t[2]] - s.positions[t[0]]).norm() / 2;
}

double area(const TriangleSoup& s) {
  double sum = 0;
  for (const Triangle& t : s.triangles) sum += face_area(s, t);
  return sum;
}

double volume(const TriangleSoup& s) {
  double sum = 0;
  for (const Triangle& t : s.triangles) sum += s.positions[t[0]].dot(s.positions[t[1]].cross(s.positions[t[2]])) / 6;
  return sum;
}

std::map<std::pair<Index, Index>, int> half_edges(const TriangleSoup& s) {
  std::map<std::pair<Index, Index>, int> count;
  for (const Triangle& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++count[{t[k], t[(k + 1) % 3]}];
  return count;
}

double longest_edge(const TriangleSoup& s) {
  double longest = 0;
  for (const auto& [edge, uses] : half_edges(s))
    longest = std::max(longest, (s.positions[edge.first] - s.positions[edge.second]).norm());
  return longest;
}

int euler(const TriangleSoup& s) {
  std::set<std::pair<Index, Index>> edges;
  for (const auto& [edge, uses] : half_edges(s)) edges.insert(std::minmax(edge.first, edge.second));
  return static_cast<int>(s.positions.size()) - static_cast<int>(edges.size()) + static_cast<int>(s.triangles.size());
}

double diagonal(const TriangleSoup& soup) {
  return Mesh(soup, "test").view().box.diagonal();
}

std::vector<TriangleSoup> closed_meshes() {
  return {make_box(Vec3(10, 1, 0.2)), make_cylinder(1, 8, 24, 1), make_torus(3, 1, 30, 5), make_sphere(2),
          transformed(shuffled(make_cylinder(1, 8, 24, 1), 3), random_rotation(4), 0.01, Vec3(5, 6, 7))};
}

TEST(Refine, KeepsTheShapeAndShortensEveryEdge) {
  for (const TriangleSoup& soup : closed_meshes())
    for (const char* max_edge : {"0.02", "0.09", "0.3"}) {
      const Caught caught = refined(soup, {{"max_edge", max_edge}});
      const double limit = std::stod(max_edge) * diagonal(soup);
      ASSERT_EQ(caught.called, longest_edge(soup) > limit);
      if (!caught.called) continue;
      EXPECT_LE(longest_edge(caught.mesh), limit * (1 + 1e-12));
      EXPECT_NEAR(area(caught.mesh) / area(soup), 1, 1e-12);
      // A volume is a difference of large terms far from the origin.
      const Vec3 origin = soup.positions[0];
      TriangleSoup before = soup, after = caught.mesh;
      for (Vec3& p : before.positions) p -= origin;
      for (Vec3& p : after.positions) p -= origin;
      EXPECT_NEAR(volume(after) / volume(before), 1, 1e-12);
      EXPECT_EQ(euler(caught.mesh), euler(soup));
      const auto halves = half_edges(caught.mesh);
      for (const auto& [edge, uses] : halves) {
        ASSERT_EQ(uses, 1);
        ASSERT_TRUE(halves.contains({edge.second, edge.first})) << "no longer watertight";
      }
    }
}

TEST(Refine, OriginsTellWhereEachFaceCameFrom) {
  const TriangleSoup soup = make_cylinder(1, 8, 24, 1);
  const Caught caught = refined(soup, {});
  std::vector<double> areas(soup.triangles.size(), 0);
  for (std::size_t f = 0; f < caught.mesh.triangles.size(); ++f) {
    ASSERT_LT(caught.mesh.face_origin[f], soup.triangles.size());
    areas[caught.mesh.face_origin[f]] += face_area(caught.mesh, caught.mesh.triangles[f]);
  }
  for (std::size_t f = 0; f < soup.triangles.size(); ++f)
    EXPECT_NEAR(areas[f] / face_area(soup, soup.triangles[f]), 1, 1e-12) << "face " << f;
}

TEST(Refine, InputVerticesStayFirstAndWhereTheyWere) {
  const TriangleSoup soup = make_cylinder(1, 8, 24, 1);
  const Caught caught = refined(soup, {});
  ASSERT_GT(caught.mesh.positions.size(), soup.positions.size());
  for (std::size_t v = 0; v < soup.positions.size(); ++v) EXPECT_EQ(caught.mesh.positions[v], soup.positions[v]);
}

TEST(Refine, EachTemplate) {
  // Triangles of which one, two and three sides are longer than 0.6 diagonals of their box.
  const TriangleSoup one{{{0, 0, 0}, {10, 0, 0}, {5, 3, 0}}, {{0, 1, 2}}, {0}, 1};
  const TriangleSoup two{{{0, 0, 0}, {10, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}, {0}, 1};
  const TriangleSoup three{{{0, 0, 0}, {10, 0, 0}, {5, 9, 0}}, {{0, 1, 2}}, {0}, 1};
  EXPECT_EQ(refined(one, {{"max_edge", "0.6"}}).mesh.triangles.size(), 2U);
  EXPECT_EQ(refined(two, {{"max_edge", "0.6"}}).mesh.triangles.size(), 3U);
  EXPECT_EQ(refined(three, {{"max_edge", "0.6"}}).mesh.triangles.size(), 4U);
}

TEST(Refine, QuadrangleIsCutAlongItsShorterDiagonal) {
  const TriangleSoup soup{{{0, 0, 0}, {10, 0, 0}, {1, 2, 0}}, {{0, 1, 2}}, {0}, 1};
  const Caught caught = refined(soup, {{"max_edge", "0.6"}});
  ASSERT_EQ(caught.mesh.triangles.size(), 3U);
  // From vertex 2 to the middle of side 01 it is sqrt(20), from vertex 0 to the middle of side 12 sqrt(31.25).
  double longest_inner = 0;
  for (const auto& [edge, uses] : half_edges(caught.mesh))
    if (half_edges(caught.mesh).contains({edge.second, edge.first}))
      longest_inner =
          std::max(longest_inner, (caught.mesh.positions[edge.first] - caught.mesh.positions[edge.second]).norm());
  EXPECT_NEAR(longest_inner, std::sqrt(20.0), 1e-12);
}

TEST(Refine, ShortEdgesAreLeftAlone) {
  EXPECT_FALSE(refined(make_sphere(3), {{"max_edge", "0.5"}}).called);
}

TEST(Refine, OpenAndNonManifoldMeshesStayConforming) {
  // Three rectangles that share one edge.
  TriangleSoup book{{{0, 0, 0}, {0, 0, 4}}, {}, {}, 0};
  for (int page = 0; page < 3; ++page) {
    const double angle = 2 * pi * page / 3;
    const Index a = static_cast<Index>(book.positions.size());
    book.positions.push_back({std::cos(angle), std::sin(angle), 0});
    book.positions.push_back({std::cos(angle), std::sin(angle), 4});
    book.triangles.push_back({0, a, a + 1});
    book.triangles.push_back({0, a + 1, 1});
  }
  book.input_faces = 6;
  book.face_origin = {0, 1, 2, 3, 4, 5};
  const Caught caught = refined(book, {{"max_edge", "0.1"}});
  std::map<std::pair<Index, Index>, int> uses;
  for (const auto& [edge, count] : half_edges(caught.mesh)) uses[std::minmax(edge.first, edge.second)] += count;
  double spine = 0;
  for (const auto& [edge, count] : uses)
    if (count == 3) spine += (caught.mesh.positions[edge.first] - caught.mesh.positions[edge.second]).norm();
  EXPECT_NEAR(spine, 4, 1e-12);
  EXPECT_EQ(euler(caught.mesh), euler(book));
}

TEST(Refine, FaceBudgetStopsWithAWarning) {
  std::vector<std::string> warnings;
  RunContext context({.threads = 1,
                      .seed = 1,
                      .time_limit_s = {},
                      .log =
                          [&](LogLevel level, std::string_view line) {
                            if (level == LogLevel::warning) warnings.emplace_back(line);
                          },
                      .progress = {}});
  const TriangleSoup soup = make_cylinder(1, 8, 24, 1);
  const Caught caught = refined(soup, {{"max_edge", "0.01"}, {"max_faces", "1000"}}, context);
  ASSERT_TRUE(caught.called);
  EXPECT_LE(caught.mesh.triangles.size(), 1000U);
  EXPECT_GT(caught.mesh.triangles.size(), soup.triangles.size());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("max_faces"), std::string::npos) << warnings[0];
}

TEST(Refine, VertexOrderAndPoseDoNotMatter) {
  const TriangleSoup soup = make_torus(3, 1, 17, 5);
  const std::size_t faces = refined(soup, {{"max_edge", "0.05"}}).mesh.triangles.size();
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const TriangleSoup other = transformed(shuffled(soup, seed), random_rotation(seed), 1e3, Vec3(1, 2, 3));
    EXPECT_NEAR(static_cast<double>(refined(other, {{"max_edge", "0.05"}}).mesh.triangles.size()),
                static_cast<double>(faces), 0.01 * static_cast<double>(faces));
  }
}

}  // namespace
