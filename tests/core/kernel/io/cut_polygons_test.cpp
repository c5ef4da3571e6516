// SPDX-License-Identifier: BSD-3-Clause
#include "io/cut_polygons.h"

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "core/kernel/io/mesh_files.h"
#include "support/meshes.h"

namespace toposcope {
namespace {

/// One face through all positions, cut.
TriangleSoup cut(std::vector<Vec3> positions) {
  TriangleSoup soup;
  soup.positions = std::move(positions);
  for (Index i = 2; i < soup.positions.size(); ++i) soup.triangles.push_back({0, i - 1, i});
  soup.face_origin.assign(soup.triangles.size(), 0);
  soup.input_faces = 1;
  cut_polygons(soup);
  return soup;
}

Vec3 area(const TriangleSoup& soup, const Triangle& t) {
  const auto& p = soup.positions;
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]) / 2;
}

/// The triangles cover the polygon once: they all face as it does, their areas sum to its own (Newell), and they are
/// glued along n - 3 cuts while each side of the polygon has one triangle.
void expect_covers(const TriangleSoup& soup, double folded_at_most = 1e-12) {
  const auto n = static_cast<Index>(soup.positions.size());
  ASSERT_EQ(soup.triangles.size(), n - 2U);
  Vec3 whole = Vec3::Zero();
  for (Index i = 0; i < n; ++i) whole += soup.positions[i].cross(soup.positions[(i + 1) % n]) / 2;
  double sum = 0;
  std::multiset<std::pair<Index, Index>> sides;
  for (const Triangle& t : soup.triangles) {
    EXPECT_GE(area(soup, t).dot(whole), -folded_at_most * whole.squaredNorm());
    sum += area(soup, t).norm();
    for (std::size_t i = 0; i < 3; ++i) sides.insert({t[i], t[(i + 1) % 3]});
  }
  EXPECT_NEAR(sum, whole.norm(), 1e-9 * whole.norm());
  for (Index i = 0; i < n; ++i) EXPECT_EQ(sides.count({i, (i + 1) % n}), 1U);
  for (const auto& [a, b] : sides) EXPECT_EQ(sides.count({b, a}), (a + 1) % n == b ? 0U : 1U) << a << ' ' << b;
}

/// A star of `points` points: every second corner turns inward.
std::vector<Vec3> star(int points, double inner) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 2 * points; ++i) {
    const double angle = std::numbers::pi * i / points, radius = i % 2 == 0 ? 1 : inner;
    positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return positions;
}

TEST(CutPolygons, StarsCombsAndSpiralsInAnyPose) {
  std::vector<std::vector<Vec3>> outlines = {star(5, 0.4), star(5, 0.01), star(50, 0.9), star(200, 0.2)};
  std::vector<Vec3> comb = {{0, -1, 0}, {20, -1, 0}};
  for (int i = 20; i >= 0; --i) comb.emplace_back(i, i % 2 == 0 ? 5 : 0, 0);
  outlines.push_back(comb);
  std::vector<Vec3> spiral;
  for (int i = 0; i <= 60; ++i)
    spiral.emplace_back(std::polar(1 + 0.1 * i, 0.3 * i).real(), std::polar(1 + 0.1 * i, 0.3 * i).imag(), 0);
  for (int i = 60; i >= 0; --i)
    spiral.emplace_back(std::polar(0.8 + 0.1 * i, 0.3 * i).real(), std::polar(0.8 + 0.1 * i, 0.3 * i).imag(), 0);
  outlines.push_back(spiral);
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    SCOPED_TRACE(i);
    expect_covers(cut(outlines[i]));
    std::vector<Vec3> moved = outlines[i];
    const Eigen::Matrix3d rotation = test::random_rotation(i + 1);
    for (Vec3& p : moved) p = 1e-3 * (rotation * p) + Vec3(3, -2, 1);
    std::reverse(moved.begin(), moved.end());
    TriangleSoup soup = cut(moved);
    for (Vec3& p : soup.positions) p -= Vec3(3, -2, 1);
    expect_covers(soup, 1e-9);
  }
}

TEST(CutPolygons, CornersOnStraightSidesStay) {
  // A square with nine corners on each side: no triangle may be flat, and every corner must be used.
  std::vector<Vec3> positions;
  for (int i = 0; i < 10; ++i) positions.emplace_back(i, 0, 0);
  for (int i = 0; i < 10; ++i) positions.emplace_back(10, i, 0);
  for (int i = 10; i > 0; --i) positions.emplace_back(i, 10, 0);
  for (int i = 10; i > 0; --i) positions.emplace_back(0, i, 0);
  const TriangleSoup soup = cut(positions);
  expect_covers(soup);
  for (const Triangle& t : soup.triangles) EXPECT_GT(area(soup, t).z(), 0.1);
}

TEST(CutPolygons, OutlinesWithoutEarsAreStillCut) {
  for (const std::vector<Vec3>& outline :
       {std::vector<Vec3>(7, Vec3(1, 2, 3)),
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},
        {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 1, 0}, {3, 1, 0}},
        {{0, 0, 0}, {1e200, 0, 0}, {1e200, 1e200, 0}, {1, 1e200, 0}, {-1e200, 1, 1e200}}})
    EXPECT_EQ(cut(outline).triangles.size(), outline.size() - 2);
}

TEST(CutPolygons, AMillionCornersTakeBoundedWork) {
  // Quadratic work would take hours.
  EXPECT_EQ(cut(star(500000, 0.5)).triangles.size(), 999998U);
}

TEST(CutPolygons, ConcavePolygonOfAFileDoesNotFold) {
  // The letter L, beginning at a corner from which the fan would fold.
  const TriangleSoup soup =
      test::read_text("v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\nf 6 1 2\n", ".obj");
  double sum = 0;
  for (std::size_t f = 0; f < 4; ++f) {
    EXPECT_GT(area(soup, soup.triangles[f]).z(), 0);
    sum += area(soup, soup.triangles[f]).z();
  }
  EXPECT_DOUBLE_EQ(sum, 3);
  EXPECT_EQ(soup.triangles[4], (Triangle{5, 0, 1}));
  EXPECT_EQ(soup.face_origin, (std::vector<Index>{0, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace toposcope
