// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Damaged soups, and by brute force what repair promises of any.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/repair.h"
#include "support/meshes.h"

namespace toposcope::test {

inline TriangleSoup soup_of(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
  TriangleSoup soup;
  soup.positions = std::move(positions);
  soup.triangles = std::move(triangles);
  soup.input_faces = static_cast<Index>(soup.triangles.size());
  for (Index f = 0; f < soup.input_faces; ++f) soup.face_origin.push_back(f);
  return soup;
}

/// Both in one, each with its own vertices.
inline TriangleSoup together(const TriangleSoup& a, const TriangleSoup& b) {
  TriangleSoup soup = soup_of(a.positions, a.triangles);
  soup.positions.insert(soup.positions.end(), b.positions.begin(), b.positions.end());
  std::vector<Triangle> triangles = a.triangles;
  const auto shift = static_cast<Index>(a.positions.size());
  for (const Triangle& t : b.triangles) triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return soup_of(std::move(soup.positions), std::move(triangles));
}

inline TriangleSoup cube_at(const Vec3& corner) {
  TriangleSoup cube = make_box({1, 1, 1});
  for (Vec3& p : cube.positions) p += corner + Vec3(0.5, 0.5, 0.5);
  return cube;
}

inline TriangleSoup moved_together(TriangleSoup soup) {  // one vertex a place
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

inline TriangleSoup separated(const TriangleSoup& soup) {  // three vertices a face
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (const Triangle& t : soup.triangles) {
    const auto first = static_cast<Index>(positions.size());
    for (Index v : t) positions.push_back(soup.positions[v]);
    triangles.push_back({first, first + 1, first + 2});
  }
  return soup_of(std::move(positions), std::move(triangles));
}

inline double volume(const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles)
    sum += soup.positions[a].dot(soup.positions[b].cross(soup.positions[c])) / 6;
  return sum;
}
inline double area(const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles)
    sum += (soup.positions[b] - soup.positions[a]).cross(soup.positions[c] - soup.positions[a]).norm() / 2;
  return sum;
}

/// By brute force: every directed edge once, no edge of more than two faces, one fan around each vertex, every vertex
/// used.
inline void expect_oriented_manifold(const TriangleSoup& soup, const std::string& what) {
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

inline void expect_same(const TriangleSoup& a, const TriangleSoup& b, const std::string& what) {
  EXPECT_EQ(a.positions, b.positions) << what;
  EXPECT_EQ(a.triangles, b.triangles) << what;
  EXPECT_EQ(a.face_origin, b.face_origin) << what;
}

/// Repaired, and then once more, which changes nothing.
inline RepairReport repaired(TriangleSoup& soup, const std::string& what) {
  const RepairReport report = repair(soup, what);
  expect_oriented_manifold(soup, what);
  TriangleSoup again = soup_of(soup.positions, soup.triangles);
  EXPECT_FALSE(repair(again, what).changed()) << what << " repaired twice";
  EXPECT_EQ(again.positions, soup.positions) << what << " repaired twice";
  EXPECT_EQ(again.triangles, soup.triangles) << what << " repaired twice";
  return report;
}

}  // namespace toposcope::test
