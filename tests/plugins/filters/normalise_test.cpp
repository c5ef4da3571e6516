// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "io/mesh_io.h"
#include "plugins/filters/filter_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

std::string text(double value) {
  return std::to_string(value);
}

Filtered normalised(const TriangleSoup& soup, int faces, Settings more = {}, Context& context = test::context()) {
  more.push_back({"faces", std::to_string(faces)});
  return filtered("normalise", soup, more, context);
}

// The greatest distance of any vertex, edge point or face point from a surface given by its distance function.
template <class Distance>
double farthest(const TriangleSoup& s, Distance distance) {
  double greatest = 0;
  for (const Triangle& t : s.triangles)
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j)
        greatest = std::max(
            greatest,
            distance(Vec3((i * s.positions[t[0]] + j * s.positions[t[1]] + (4 - i - j) * s.positions[t[2]]) / 4)));
  return greatest;
}

double distance_to_box(const Vec3& x, const Vec3& sides) {
  const Vec3 beyond = x.cwiseAbs() - sides / 2;
  return std::abs(beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0));
}

void expect_faces(const TriangleSoup& s, int faces, double within = 0.03) {
  EXPECT_NEAR(static_cast<double>(s.triangles.size()), faces, std::max(1.0, within * faces));
}

TEST(Normalise, SphereHasEvenEdges) {
  const TriangleSoup soup = make_sphere(5);  // 20480 faces
  for (const int faces : {2000, 20000, 40000}) {
    const TriangleSoup result = normalised(soup, faces).mesh;
    expect_faces(result, faces);
    EXPECT_LT(edge_variation(result), 0.2);
    EXPECT_TRUE(is_manifold(result));
    EXPECT_EQ(euler(result), 2);
    EXPECT_NEAR(area(result) / (4 * pi), 1, 0.01);
    EXPECT_NEAR(volume(result) / (4 * pi / 3), 1, 0.01);
    // The sagitta of an equilateral triangle of this area, with room for edges twice as long.
    const double sagitta = 4 * pi / faces * 4 / std::sqrt(3.0) / 6;
    EXPECT_LT(farthest(result, [](const Vec3& x) { return std::abs(x.norm() - 1); }), 4 * sagitta);
    for (const Triangle& t : result.triangles) EXPECT_GT(face_normal(result, t).dot(result.positions[t[0]]), 0);
    expect_nearest_origins(result, soup);
  }
}

TEST(Normalise, TorusKeepsItsHole) {
  const TriangleSoup soup = make_torus(3, 1, 200, 30);
  const TriangleSoup result = normalised(soup, 3000).mesh;
  expect_faces(result, 3000);
  EXPECT_LT(edge_variation(result), 0.2);
  EXPECT_TRUE(is_manifold(result));
  EXPECT_EQ(euler(result), 0);
  EXPECT_NEAR(volume(result) / (2 * pi * pi * 3), 1, 0.02);
  EXPECT_LT(farthest(result, [](const Vec3& x) { return std::abs(std::hypot(x.head<2>().norm() - 3, x.z()) - 1); }),
            0.04);
}

TEST(Normalise, CubeKeepsItsCornersAndEdges) {
  const Vec3 sides(2, 3, 1);
  for (const int n : {1, 13})
    for (const int faces : {300, 3000}) {
      const TriangleSoup result = normalised(make_box(sides, n), faces).mesh;
      expect_faces(result, faces);
      EXPECT_LT(edge_variation(result), 0.25);
      EXPECT_TRUE(is_manifold(result));
      EXPECT_EQ(euler(result), 2);
      EXPECT_NEAR(volume(result), 6, 1e-9);
      EXPECT_NEAR(area(result), 22, 1e-9);
      int corners = 0;
      for (const Vec3& p : result.positions) corners += (p.cwiseAbs() - sides / 2).norm() < 1e-12;
      EXPECT_EQ(corners, 8);
      EXPECT_LT(farthest(result, [&](const Vec3& x) { return distance_to_box(x, sides); }), 1e-12);
    }
}

TEST(Normalise, SquareKeepsItsBoundary) {
  for (const int n : {1, 20}) {
    const TriangleSoup soup = make_grid(n, n, 2, 2);
    const TriangleSoup result = normalised(soup, 500).mesh;
    expect_faces(result, 500);
    EXPECT_LT(edge_variation(result), 0.2);
    EXPECT_NEAR(area(result), 4, 1e-12);
    EXPECT_EQ(euler(result), 1);
    for (const Triangle& t : result.triangles) EXPECT_GT(face_normal(result, t).z(), 0);
    int boundary = 0;
    EXPECT_TRUE(is_manifold(result, &boundary));
    EXPECT_NEAR(boundary, 8 / std::sqrt(4 / std::sqrt(3.0) * 4 / 500), 8);
    expect_nearest_origins(result, soup);
  }
}

TEST(Normalise, OpenCylinderKeepsItsCircles) {
  const TriangleSoup soup = make_cylinder(1, 3, 90, 7, false);
  const TriangleSoup result = normalised(soup, 2000).mesh;
  expect_faces(result, 2000);
  EXPECT_LT(edge_variation(result), 0.2);
  EXPECT_EQ(euler(result), 0);
  EXPECT_TRUE(is_manifold(result));
  const std::vector<Index> opposite = opposite_half_edges(Mesh(result, "test").view());
  double length[2] = {0, 0};
  for (std::size_t h = 0; h < opposite.size(); ++h) {
    if (opposite[h] != no_index) continue;
    const Vec3& p = result.positions[result.triangles[h / 3][h % 3]];
    const Vec3& q = result.positions[result.triangles[h / 3][(h + 1) % 3]];
    EXPECT_NEAR(std::abs(p.z()), 1.5, 1e-12);
    EXPECT_NEAR(p.z(), q.z(), 1e-12);
    EXPECT_GT(p.head<2>().norm(), std::cos(pi / 90) - 1e-12);
    length[p.z() > 0] += (p - q).norm();
  }
  for (double circle : length) EXPECT_NEAR(circle, 2 * pi, 0.05);
}

TEST(Normalise, LongThinTrianglesBecomeEven) {
  // As CAD programs write them: vertices on the edges of the can only.
  const TriangleSoup soup = make_cylinder(1, 8, 64, 1);
  const TriangleSoup result = normalised(soup, 5000).mesh;
  expect_faces(result, 5000);
  EXPECT_LT(edge_variation(result), 0.2);
  EXPECT_NEAR(volume(result) / volume(soup), 1, 0.005);
  int on_rims = 0;
  for (const Vec3& p : result.positions)
    on_rims += std::abs(std::abs(p.z()) - 4) < 1e-9 && p.head<2>().norm() > std::cos(pi / 64) - 1e-9;
  const double edge = std::sqrt(4 / std::sqrt(3.0) * area(soup) / 5000);
  EXPECT_NEAR(on_rims, 2 * 2 * pi / edge, 0.2 * 4 * pi / edge);
}

TEST(Normalise, ShapeChangeIsBounded) {
  const TriangleSoup soup = make_torus(3, 1, 40, 16);
  for (const double bound : {0.002, 0.01, 0.04}) {
    Listening listening;
    const TriangleSoup result = normalised(soup, 100, {{"max_change", text(bound)}}, listening.context).mesh;
    const double allowed = bound * diagonal(soup);
    EXPECT_LE(brute_distance(soup, result, 3), allowed) << bound;
    EXPECT_LE(brute_distance(result, soup, 3), allowed) << bound;
    if (bound < 0.01) {
      ASSERT_EQ(listening.warnings.size(), 1U) << "it can not have reached 100 faces";
      EXPECT_NE(listening.warnings[0].find("max_change"), std::string::npos) << listening.warnings[0];
    }
  }
}

TEST(Normalise, EdgeLengthIsReached) {
  const TriangleSoup soup = make_torus(3, 1, 60, 20);
  for (const double edge : {0.02, 0.05}) {
    const TriangleSoup result = filtered("normalise", soup, {{"edge", text(edge)}}).mesh;
    EXPECT_NEAR(Mesh(result, "test").view().mean_edge / diagonal(soup), edge, 0.05 * edge);
  }
  const TriangleSoup result = filtered("normalise", soup, {}).mesh;
  EXPECT_NEAR(Mesh(result, "test").view().mean_edge / Mesh(soup, "test").view().mean_edge, 1, 0.05);
}

TEST(Normalise, ComponentsStayApart) {
  TriangleSoup soup = make_sphere(3);
  const TriangleSoup other = transformed(make_torus(3, 1, 40, 16), Eigen::Matrix3d::Identity(), 1, Vec3(10, 0, 0));
  const auto shift = static_cast<Index>(soup.positions.size());
  soup.positions.insert(soup.positions.end(), other.positions.begin(), other.positions.end());
  for (const Triangle& t : other.triangles) soup.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  soup.input_faces = static_cast<Index>(soup.triangles.size());
  soup.face_origin.resize(soup.triangles.size());
  const TriangleSoup result = normalised(soup, 3000).mesh;
  EXPECT_EQ(euler(result), 2 + 0);
  EXPECT_TRUE(is_manifold(result));
  expect_faces(result, 3000);
}

TEST(Normalise, SmallAndHostileMeshes) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::vector<Triangle>> meshes = {
      {{0, 1, 2}}, {{0, 1, 2}, {1, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  for (const std::vector<Triangle>& triangles : meshes) {
    TriangleSoup soup{corners, triangles, {}, static_cast<Index>(triangles.size())};
    soup.face_origin.resize(triangles.size());
    for (const int faces : {1, 20, 20000}) {
      const TriangleSoup result = normalised(soup, faces).mesh;
      EXPECT_TRUE(is_manifold(result));
      EXPECT_EQ(euler(result), euler(soup));
      EXPECT_NEAR(area(result), area(soup), 1e-9);
      if (faces > 1) expect_faces(result, faces, faces > 100 ? 0.03 : 0.2);
    }
  }
  // Needles and doubled points.
  TriangleSoup needles = make_box(Vec3(1, 1e-9, 1e-3), 3);
  needles.positions[5] = needles.positions[6];
  EXPECT_TRUE(is_manifold(normalised(needles, 400).mesh));
}

TEST(Normalise, NonManifoldMeshesAreRefused) {
  TriangleSoup book{{{0, 0, 0}, {0, 0, 4}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {}, {}, 0};
  book.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  book.face_origin = {0, 1, 2};
  book.input_faces = 3;
  try {
    normalised(book, 100);
    FAIL() << "not refused";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("prepare"), std::string::npos) << error.what();
  }
  EXPECT_ANY_THROW(test::filter("normalise", {{"faces", "100"}, {"edge", "0.1"}}));
}

TEST(Normalise, SameAtAnyThreadCount) {
  const TriangleSoup soup = make_torus(3, 1, 80, 30);
  const TriangleSoup one = normalised(soup, 3000, {}, test::context(1)).mesh;
  const TriangleSoup four = normalised(soup, 3000, {}, test::context(4)).mesh;
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(one.triangles, four.triangles);
  EXPECT_EQ(one.face_origin, four.face_origin);
}

TEST(Normalise, PoseScaleAndOrderHardlyMatter) {
  const TriangleSoup soup = make_can(1, 3, 40, 30, 10);
  const TriangleSoup plain = normalised(soup, 3000).mesh;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TriangleSoup other = transformed(shuffled(soup, seed), random_rotation(seed), 1000, Vec3(10, 20, 30));
    const TriangleSoup result = normalised(other, 3000).mesh;
    expect_faces(result, 3000);
    EXPECT_NEAR(edge_variation(result), edge_variation(plain), 0.02);
    EXPECT_NEAR(volume(result) / volume(other), volume(plain) / volume(soup), 0.001);
  }
}

TEST(Normalise, RealMeshes) {
  const std::filesystem::path data = std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "../shared/data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no real meshes at " << data;
  for (const char* name :
       {"psb/cup/39.off", "psb/airplane/63.off", "fittings/pvc_tee_32mm.stl", "scans/ycb_025_mug.ply"}) {
    const TriangleSoup soup = read_soup(data / name);
    for (const int faces : {5000, 20000}) {
      const TriangleSoup result = normalised(soup, faces).mesh;
      expect_faces(result, faces);
      EXPECT_LE(edge_variation(result), 0.25) << name << ' ' << faces;
      EXPECT_TRUE(is_manifold(result));
      EXPECT_EQ(euler(result), euler(soup));
      if (faces != 20000) continue;
      const ClosestFace to_input(soup.positions, soup.triangles), to_result(result.positions, result.triangles);
      const double allowed = 0.005 * diagonal(soup);
      EXPECT_LE(farthest(result, [&](const Vec3& x) { return std::sqrt(to_input(x).squared_distance); }), allowed);
      EXPECT_LE(farthest(soup, [&](const Vec3& x) { return std::sqrt(to_result(x).squared_distance); }), allowed);
    }
  }
}

/// Is cancelled when it was asked so many times; counts the work that is begun all the same.
class Impatient final : public Context {
 public:
  explicit Impatient(int patience) : patience_(patience) {}
  int begun_too_late() const { return begun_too_late_; }
  void log(LogLevel, std::string_view) override {}
  void progress(double) override { begun_too_late_ += patience_ < 0; }
  bool cancelled() const override { return patience_ < 0 || --patience_ < 0; }
  std::uint64_t seed() const override { return 1; }
  unsigned threads() const override { return 1; }
  void parallel_for(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) override {
    begun_too_late_ += patience_ < 0;
    test::context().parallel_for(count, grain, body);
  }
  std::uint64_t memory_budget() const override { return test::context().memory_budget(); }

 private:
  mutable int patience_;
  int begun_too_late_ = 0;
};

/// Each step of millions of faces takes minutes: cancelled, the next is not begun.
TEST(Normalise, CancelledItLeavesOff) {
  const Mesh mesh(make_can(1, 3, 40, 30, 10), "can");
  for (const int patience : {0, 1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144}) {
    Impatient context(patience);
    Filtered result;
    result.mesh.input_faces = mesh.view().face_count();
    test::filter("normalise", {{"faces", "3000"}})->apply(mesh.view(), context, result);
    EXPECT_EQ(context.begun_too_late(), 0) << patience;
    EXPECT_TRUE(!result.called || is_manifold(result.mesh)) << patience;
  }
}

/// So long for its area that its faces' edges would fit a million times into its length.
TEST(Normalise, ANeedleTakesWorkInProportion) {
  TriangleSoup needle = make_cylinder(1e-6, 2, 40, 18);
  Listening listening;
  const TriangleSoup result = normalised(needle, 500, {}, listening.context).mesh;
  EXPECT_TRUE(is_manifold(result));
  EXPECT_LT(result.triangles.size(), 64 * (500 + needle.triangles.size()));
  EXPECT_ANY_THROW(filtered("normalise", needle, {{"edge", "1e-9"}}));
}

/// There is no room for an edge of the wanted length: the goal may not fall to no face at all.
TEST(Normalise, OneTriangleAndASurfaceWithoutAreaComeBack) {
  const auto single = [](const Vec3& top) {
    TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, top};
    soup.triangles = {{0, 1, 2}};
    soup.face_origin = {0};
    soup.input_faces = 1;
    return soup;
  };
  EXPECT_LE(filtered("normalise", single({0.2, 0.9, 0}), {}).mesh.triangles.size(), 8u);
  Listening listening;
  EXPECT_FALSE(filtered("normalise", single({0.5, 0, 0}), {}, listening.context).called);
  EXPECT_EQ(listening.warnings.size(), 1u);
}

}  // namespace
