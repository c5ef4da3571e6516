// SPDX-License-Identifier: BSD-3-Clause
// A mesh with too many triangles is shown with fewer: within the budget, near the surface, every label where it was.

#include "scene/display_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "mesh/mesh.h"
#include "support/meshes.h"
#include "toposcope/geometry/closest_face.h"

namespace toposcope {
namespace {

Vec3 middle(std::span<const Vec3> positions, const Triangle& t) {
  return (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3;
}

double area(const std::vector<Vec3>& positions, const Triangle& t) {
  return (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]).norm() / 2;
}

/// A sphere of 20,480 faces: label 1 above z = 0.5, 2 in a patch around +x, none elsewhere.
struct Labelled {
  Mesh mesh{test::make_sphere(5), "sphere"};
  std::vector<std::uint8_t> labels;
  Labelled() {
    for (const Triangle& t : mesh.view().triangles) {
      const Vec3 at = middle(mesh.view().positions, t);
      labels.push_back(at.z() > 0.5 ? 1 : at.x() > 0.8 ? 2 : 0);
    }
  }
};

TEST(DisplayMesh, ASmallMeshIsShownWhole) {
  const Labelled sphere;
  const DisplayMesh shown = display_mesh(sphere.mesh.view(), sphere.labels);
  EXPECT_EQ(shown.triangles.size(), sphere.mesh.view().face_count());
  EXPECT_EQ(shown.labels, sphere.labels);
  EXPECT_TRUE(shown.faces.empty() && shown.vertex_ids.empty());
  EXPECT_EQ(shown.shown(std::vector<Index>{5, 3, 5}), (std::vector<Index>{3, 5}));
}

TEST(DisplayMesh, ALargeMeshKeepsItsLabelsWithinTheBudget) {
  const Labelled sphere;
  const MeshView& view = sphere.mesh.view();
  const std::vector<Vec3> positions(view.positions.begin(), view.positions.end());
  const std::size_t limit = 2000;
  const DisplayMesh shown = display_mesh(view, sphere.labels, limit);
  EXPECT_LE(shown.triangles.size(), limit);
  EXPECT_GT(shown.triangles.size(), limit * 9 / 10);
  EXPECT_EQ(shown.mesh_triangles, view.face_count());
  ASSERT_EQ(shown.labels.size(), shown.triangles.size());
  ASSERT_EQ(shown.faces.size(), shown.triangles.size());

  // Each label covers as much as before, and the line between two labels has not moved.
  double before[3] = {}, after[3] = {};
  for (Index t = 0; t < view.face_count(); ++t) before[sphere.labels[t]] += area(positions, view.triangles[t]);
  const ClosestFace nearest(view.positions, view.triangles);
  std::size_t elsewhere = 0;
  for (std::size_t t = 0; t < shown.triangles.size(); ++t) {
    after[shown.labels[t]] += area(shown.positions, shown.triangles[t]);
    const ClosestFace::Hit hit = nearest(middle(shown.positions, shown.triangles[t]));
    EXPECT_LT(hit.squared_distance, 0.02 * 0.02);
    elsewhere += sphere.labels[hit.face] != shown.labels[t];
    EXPECT_EQ(sphere.labels[shown.faces[t]], shown.labels[t]);
  }
  for (int label = 0; label < 3; ++label) EXPECT_NEAR(after[label], before[label], 0.02 * before[label]) << label;
  EXPECT_LE(elsewhere, shown.triangles.size() / 100);

  // Every vertex is stood for by one nearby.
  ASSERT_EQ(shown.shown_as.size(), view.vertex_count());
  for (Index v = 0; v < view.vertex_count(); ++v)
    EXPECT_LT((shown.positions[shown.shown_as[v]] - positions[v]).norm(), 0.2);
  for (Index s = 0; s < shown.vertex_ids.size(); ++s) EXPECT_EQ(shown.shown_as[shown.vertex_ids[s]], s);
}

TEST(DisplayMesh, StaysClosed) {
  const Labelled sphere;
  const DisplayMesh shown = display_mesh(sphere.mesh.view(), sphere.labels, 2000);
  std::multiset<std::pair<Index, Index>> edges;
  for (const Triangle& t : shown.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(t[k], t[(k + 1) % 3]);
  for (const auto& [a, b] : edges) EXPECT_EQ(edges.count({b, a}), 1U) << "an edge without its neighbour";
}

}  // namespace
}  // namespace toposcope
