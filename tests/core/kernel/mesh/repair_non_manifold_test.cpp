// SPDX-License-Identifier: BSD-3-Clause

// Edges of more than two faces, vertices of more than one fan, surfaces that cannot be oriented.

#include <gtest/gtest.h>

#include "repair_fixture.h"

namespace toposcope {
namespace {

using namespace test;

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

}  // namespace
}  // namespace toposcope
