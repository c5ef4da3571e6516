// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Filters as tests see them: a mesh in, a mesh out, and the measures that both are held to.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "toposcope/filters.h"
#include "toposcope/geometry/closest_face.h"

namespace toposcope::test {

struct Filtered final : MeshSink {
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

inline Filtered filtered(const char* id, const TriangleSoup& soup, const Settings& settings,
                         Context& context = test::context()) {
  const Mesh mesh(soup, "test");
  Filtered result;
  result.mesh.input_faces = mesh.view().face_count();
  test::filter(id, settings)->apply(mesh.view(), context, result);
  return result;
}

/// A context that keeps its warnings.
struct Listening {
  std::vector<std::string> warnings;
  RunContext context{{.threads = 1,
                      .seed = 1,
                      .time_limit_s = {},
                      .log =
                          [this](LogLevel level, std::string_view line) {
                            if (level == LogLevel::warning) warnings.emplace_back(line);
                          },
                      .progress = {}}};
};

inline Vec3 face_normal(const TriangleSoup& s, const Triangle& t) {
  return (s.positions[t[1]] - s.positions[t[0]]).cross(s.positions[t[2]] - s.positions[t[0]]) / 2;
}

inline double area(const TriangleSoup& s) {
  double sum = 0;
  for (const Triangle& t : s.triangles) sum += face_normal(s, t).norm();
  return sum;
}

inline double volume(const TriangleSoup& s) {
  double sum = 0;
  for (const Triangle& t : s.triangles) sum += s.positions[t[0]].dot(s.positions[t[1]].cross(s.positions[t[2]])) / 6;
  return sum;
}

inline double diagonal(const TriangleSoup& soup) {
  return Mesh(soup, "test").view().box.diagonal();
}

inline std::set<std::pair<Index, Index>> edges(const TriangleSoup& s) {
  std::set<std::pair<Index, Index>> result;
  for (const Triangle& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) result.insert(std::minmax(t[k], t[(k + 1) % 3]));
  return result;
}

/// Standard deviation of the edges' lengths over their mean.
inline double edge_variation(const TriangleSoup& s) {
  double sum = 0, squares = 0, count = 0;
  for (const auto& [v, w] : edges(s)) {
    const double length = (s.positions[v] - s.positions[w]).norm();
    sum += length;
    squares += length * length;
    ++count;
  }
  return std::sqrt(std::max(0.0, squares * count / (sum * sum) - 1));
}

/// Vertices that have faces, less edges, plus faces.
inline int euler(const TriangleSoup& s) {
  std::set<Index> used;
  for (const Triangle& t : s.triangles) used.insert(t.begin(), t.end());
  return static_cast<int>(used.size()) - static_cast<int>(edges(s).size()) + static_cast<int>(s.triangles.size());
}

/// Whether every edge has one or two faces that agree on its direction, every vertex one fan; and how many edges have
/// one face.
inline bool is_manifold(const TriangleSoup& s, int* boundary_edges = nullptr) {
  const Mesh mesh(s, "test");
  try {
    const std::vector<Index> opposite = opposite_half_edges(mesh.view());
    if (boundary_edges) *boundary_edges = static_cast<int>(std::count(opposite.begin(), opposite.end(), no_index));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// The greatest distance from points spread over `from` (n to a side of each face) to `to`, every face tried.
inline double brute_distance(const TriangleSoup& from, const TriangleSoup& to, int n) {
  double greatest = 0;
  for (const Triangle& t : from.triangles)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 x = (i * from.positions[t[0]] + j * from.positions[t[1]] + (n - i - j) * from.positions[t[2]]) / n;
        double least = 1e300;
        for (const Triangle& u : to.triangles)
          least = std::min(
              least,
              (closest_on_triangle(to.positions[u[0]], to.positions[u[1]], to.positions[u[2]], x).point - x).norm());
        greatest = std::max(greatest, least);
      }
  return greatest;
}

/// Every face has an origin, and no other face of the input is nearer to its centre.
inline void expect_nearest_origins(const TriangleSoup& output, const TriangleSoup& input) {
  ASSERT_EQ(output.face_origin.size(), output.triangles.size());
  const std::size_t stride = 1 + output.triangles.size() / 200;
  for (std::size_t f = 0; f < output.triangles.size(); f += stride) {
    const Triangle& t = output.triangles[f];
    const Vec3 center = (output.positions[t[0]] + output.positions[t[1]] + output.positions[t[2]]) / 3;
    const auto distance = [&](const Triangle& u) {
      return (closest_on_triangle(input.positions[u[0]], input.positions[u[1]], input.positions[u[2]], center).point -
              center)
          .norm();
    };
    ASSERT_LT(output.face_origin[f], input.triangles.size());
    double least = 1e300;
    for (const Triangle& u : input.triangles) least = std::min(least, distance(u));
    EXPECT_LE(distance(input.triangles[output.face_origin[f]]), least * (1 + 1e-9) + 1e-12);
  }
}

}  // namespace toposcope::test
