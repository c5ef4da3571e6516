// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/run_context.h"
#include "mesh/mesh.h"
#include "pipeline/working_sets.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "toposcope/geometry/curvature.h"

namespace toposcope {
namespace {

const std::vector<std::string> types = {"convex", "concave", "planar"};

WorkingSets classify(const Mesh& mesh, unsigned threads = 2,
                     const std::vector<std::pair<std::string, std::string>>& options = {}) {
  RunSettings settings;
  settings.threads = threads;
  RunContext context(settings);
  // classify_mesh refuses sets that are not connected, out of range or of a type that is not provided.
  const WorkingSetStation station{"curvature-tree", types, test::worksets("curvature-tree", options)};
  return classify_mesh(mesh.view(), {&station, 1}, context);
}

/// Every set is a whole component of {field >= t}: nothing just outside of it is as high as its lowest vertex.
TEST(CurvatureTree, SetsAreComponentsOfAThreshold) {
  const Mesh mesh(test::make_torus(2, 0.6, 60, 30), "torus");
  const MeshView& view = mesh.view();
  RunContext context;
  ShapeOperators operators = fit_shape_operators(view, context);
  diffuse(view, operators, diffusion_passes(view, 0.015 * view.box.diagonal(), 1), context);
  const Curvature curvature = principal_curvatures(operators);
  const WorkingSets sets = classify(mesh, 2, {{"reach", "0"}});
  ASSERT_GT(sets.size(), 3u);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const std::string& type = sets.type_names[sets.types[s]];
    const auto field = [&](Index v) {
      const double high = curvature.maximum[v], low = curvature.minimum[v];
      if (type == "planar") return -std::log(std::max(std::abs(high), std::abs(low)));
      return std::log(std::max(1e-9, type == "convex" ? high : -low));
    };
    double lowest = std::numeric_limits<double>::infinity(), highest_beside = -lowest;
    for (Index v : sets[s]) lowest = std::min(lowest, field(v));
    const std::set<Index> inside(sets[s].begin(), sets[s].end());
    for (Index v : sets[s])
      for (Index q : view.one_ring(v))
        if (!inside.contains(q)) highest_beside = std::max(highest_beside, field(q));
    EXPECT_LE(highest_beside, lowest + 0.02 + 1e-9) << "set " << s;  // the field is read in steps of 0.02
  }
}

/// The two rims of a can: some convex set holds each of them and nothing else.
TEST(CurvatureTree, OffersTheEdgesOfACylinder) {
  const Mesh mesh(test::make_can(1, 3, 64, 30, 10), "can");
  const MeshView& view = mesh.view();
  const WorkingSets sets = classify(mesh);
  double top = -1e9, bottom = 1e9;
  for (const Vec3& p : view.positions) {
    top = std::max(top, p.z());
    bottom = std::min(bottom, p.z());
  }
  for (double level : {top, bottom}) {
    std::set<Index> rim;
    for (Index v = 0; v < view.vertex_count(); ++v)
      if (std::abs(view.positions[v].z() - level) < 1e-9 && view.positions[v].head<2>().norm() > 0.999) rim.insert(v);
    ASSERT_GT(rim.size(), 32u);
    bool offered = false;
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if (sets.type_names[sets.types[s]] != "convex") continue;
      const auto hit = std::count_if(sets[s].begin(), sets[s].end(), [&](Index v) { return rim.contains(v); });
      const auto near = std::count_if(sets[s].begin(), sets[s].end(), [&](Index v) {
        return std::abs(view.positions[v].z() - level) < 0.5 && view.positions[v].head<2>().norm() > 0.7;
      });
      offered = offered || (hit == std::ssize(rim) && near == std::ssize(sets[s]));
    }
    EXPECT_TRUE(offered) << "level " << level;
  }
}

/// A sheet a tenth of an edge thick, as wings of coarse meshes are: one set holds its whole border and nothing else.
TEST(CurvatureTree, OffersTheEdgeOfAThinSheet) {
  constexpr double edge = 0.125, width = 4;
  const Mesh mesh(test::make_sheet(width, edge / 10, static_cast<int>(width / edge)), "sheet");
  const MeshView& view = mesh.view();
  const auto inside = [&](Index v) {  // how far from the border
    const Vec3 arm = view.positions[v] - view.box.center;
    return width / 2 - std::max(std::abs(arm.x()), std::abs(arm.y()));
  };
  Index border = 0;
  for (Index v = 0; v < view.vertex_count(); ++v) border += inside(v) < 1e-9;
  const WorkingSets sets = classify(mesh);
  bool offered = false;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets.type_names[sets.types[s]] != "convex") continue;
    const auto on = std::count_if(sets[s].begin(), sets[s].end(), [&](Index v) { return inside(v) < 1e-9; });
    const auto near = std::count_if(sets[s].begin(), sets[s].end(), [&](Index v) { return inside(v) < 1.5 * edge; });
    offered = offered || (on == border && near == std::ssize(sets[s]));
  }
  EXPECT_TRUE(offered);
}

/// The border of a long thin sheet comes whole and in two halves; that of a square one only whole.
TEST(CurvatureTree, OffersTheHalvesOfALongRing) {
  constexpr double edge = 0.125, width = 4;
  TriangleSoup soup = test::make_sheet(width, edge / 10, static_cast<int>(width / edge));
  const Mesh square(soup, "sheet");
  for (Vec3& p : soup.positions) p.x() *= 2.5;
  const Mesh sheet(soup, "long sheet");
  const auto sides = [&](const Mesh& mesh, const std::string& halves) {  // of sets along a border: how many reach where
    const Box& box = mesh.view().box;
    std::array<int, 3> count = {};  // both ends, the low one, the high one
    const WorkingSets sets = classify(mesh, 2, {{"halves", halves}});
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if (sets.type_names[sets.types[s]] != "convex") continue;
      double low = 1e9, high = -1e9;
      for (Index v : sets[s]) {
        const double x = (mesh.view().positions[v] - box.center).x() / box.a();
        low = std::min(low, x);
        high = std::max(high, x);
      }
      if (low < -0.49 && high > 0.49) ++count[0];
      if (low < -0.49 && high < 0.01 && high > -0.1) ++count[1];
      if (high > 0.49 && low > -0.01 && low < 0.1) ++count[2];
    }
    return count;
  };
  const auto with = sides(sheet, "true"), without = sides(sheet, "false");
  EXPECT_GT(with[0], 0);
  EXPECT_GT(with[1], 0);
  EXPECT_EQ(with[1], with[2]);
  EXPECT_EQ(without[0], with[0]);
  EXPECT_EQ(without[1] + without[2], 0);
  EXPECT_EQ(sides(square, "true"), sides(square, "false"));
}

TEST(CurvatureTree, IsTheSameAtAnyThreadCountAndScale) {
  TriangleSoup soup = test::make_torus(2, 0.6, 60, 30);
  const Mesh mesh(soup, "torus");
  for (Vec3& p : soup.positions) p *= 1024;  // a power of two: exact
  const Mesh scaled(soup, "torus");
  const WorkingSets one = classify(mesh, 1), two = classify(mesh, 2), large = classify(scaled, 2);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.offsets, two.offsets);
  EXPECT_EQ(one.vertices, large.vertices);
}

/// A prism of 48 sides: its wall, its two edges and its two ends, each exactly.
TEST(CurvatureTree, OffersThePartsOfATessellation) {
  const Mesh mesh(test::make_cylinder(1, 3, 48, 1), "prism");
  const MeshView& view = mesh.view();
  const WorkingSets sets = classify(mesh);
  const auto offered = [&](const char* type, const auto& belongs) {
    std::set<Index> wanted;
    for (Index v = 0; v < view.vertex_count(); ++v)
      if (belongs(view.positions[v])) wanted.insert(v);
    for (std::size_t s = 0; s < sets.size(); ++s)
      if (sets.type_names[sets.types[s]] == type && std::set<Index>(sets[s].begin(), sets[s].end()) == wanted)
        return true;
    return false;
  };
  EXPECT_TRUE(offered("convex", [](const Vec3& p) { return p.head<2>().norm() > 0.5; }));
  for (const double side : {-1, 1}) {
    EXPECT_TRUE(offered("convex", [&](const Vec3& p) { return p.head<2>().norm() > 0.5 && side * p.z() > 0; }));
    EXPECT_TRUE(offered("planar", [&](const Vec3& p) { return side * p.z() > 0; }));
  }
}

/// All of a smooth round thing is one of its parts.
TEST(CurvatureTree, OffersTheWholeMesh) {
  const Mesh mesh(test::make_sphere(3), "sphere");
  const WorkingSets sets = classify(mesh);
  bool offered = false;
  for (std::size_t s = 0; s < sets.size(); ++s)
    offered = offered || (sets.type_names[sets.types[s]] == "convex" && sets[s].size() == mesh.view().vertex_count());
  EXPECT_TRUE(offered);
}

TEST(CurvatureTree, KeepsItsLimits) {
  const Mesh mesh(test::make_torus(2, 0.6, 60, 30), "torus");
  const WorkingSets sets =
      classify(mesh, 2, {{"max_sets", "5"}, {"min_vertices", "10"}, {"max_part", "0.2"}, {"creases", "false"}});
  std::map<Index, int> count;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    ++count[sets.types[s]];
    EXPECT_GE(sets[s].size(), 10u);
    EXPECT_LE(sets[s].size(), mesh.view().vertex_count() / 5);
  }
  // Of convex sets there are those of two fields; no ring of the torus is long.
  for (const auto& [type, number] : count) EXPECT_LE(number, sets.type_names[type] == "convex" ? 10 : 5) << types[type];
}

}  // namespace
}  // namespace toposcope
