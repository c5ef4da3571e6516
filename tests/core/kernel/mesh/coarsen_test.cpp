// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/coarsen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "mesh/repair.h"
#include "support/meshes.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

CoarseMesh coarse_of(const MeshView& mesh, std::size_t faces, unsigned threads = 1) {
  std::optional<CoarseMesh> coarse = coarsen(mesh, faces, test::context(threads));
  if (!coarse) throw std::runtime_error("nothing coarse");
  return std::move(*coarse);
}

/// What a repair says of a mesh; it must have nothing to do.
RepairReport topology_of(const MeshView& mesh) {
  TriangleSoup soup{{mesh.positions.begin(), mesh.positions.end()}, {mesh.triangles.begin(), mesh.triangles.end()}, {}};
  soup.face_origin.resize(soup.triangles.size());
  std::iota(soup.face_origin.begin(), soup.face_origin.end(), Index{0});
  soup.input_faces = mesh.face_count();
  const RepairReport report = repair(soup, "mesh");
  EXPECT_FALSE(report.changed());
  EXPECT_FALSE(report.notable());
  return report;
}

/// A square with round holes: cells whose middle lies in one are left out.
TriangleSoup plate_with_holes(int n, double radius) {
  TriangleSoup soup = test::make_grid(n, n);
  std::size_t kept = 0;
  for (const Triangle& t : soup.triangles) {
    const Vec3 middle = (soup.positions[t[0]] + soup.positions[t[1]] + soup.positions[t[2]]) / 3;
    if (std::hypot(std::abs(middle.x()) - 0.25, std::abs(middle.y()) - 0.25) > radius) soup.triangles[kept++] = t;
  }
  soup.triangles.resize(kept);
  soup.face_origin.resize(kept);
  repair(soup, "plate");  // drops the vertices in the holes
  return soup;
}

TEST(Coarsen, KeepsTheForm) {
  const struct {
    const char* name;
    TriangleSoup soup;
    std::size_t faces;
  } cases[] = {
      {"sphere", test::make_sphere(5), 500},
      {"torus", test::make_torus(2, 0.7, 150, 60), 800},
      {"a wire that is thinner than the edges", test::make_torus(2, 0.03, 800, 12), 200},
      {"a sheet that is thinner than the edges", test::make_sheet(1, 0.002, 60), 400},
      {"a disc", test::make_grid(80, 80), 300},
      {"holes that are smaller than the edges", plate_with_holes(120, 0.02), 300},
      {"a tube without ends", test::make_cylinder(1, 4, 120, 60, false), 400},
  };
  for (const auto& [name, soup, faces] : cases) {
    SCOPED_TRACE(name);
    const Mesh fine(soup, name);
    const CoarseMesh coarse = coarse_of(fine.view(), faces);
    const RepairReport was = topology_of(fine.view()), is = topology_of(coarse.mesh.view());
    EXPECT_EQ(is.components, was.components);
    EXPECT_EQ(is.closed_components, was.closed_components);
    EXPECT_EQ(is.holes, was.holes);
    EXPECT_EQ(is.genus, was.genus);
    EXPECT_LT(coarse.mesh.view().face_count(), 0.7 * fine.view().face_count());
  }
}

TEST(Coarsen, ClustersAreConnectedAndHoldEachVertexOnce) {
  const Mesh fine(test::make_torus(2, 0.7, 150, 60), "torus");
  const CoarseMesh coarse = coarse_of(fine.view(), 500);
  ASSERT_EQ(coarse.clusters.size(), coarse.mesh.view().vertex_count());
  std::vector<int> held(fine.view().vertex_count(), 0);
  for (Index c = 0; c < coarse.clusters.size(); ++c) {
    std::vector<Index> reached = {coarse.clusters[c].front()};
    std::vector<bool> seen(held.size(), false);
    seen[reached.front()] = true;
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (const Index q : fine.view().one_ring(reached[i]))
        if (!seen[q] && coarse.clusters.of[q] == c) {
          seen[q] = true;
          reached.push_back(q);
        }
    EXPECT_EQ(reached.size(), coarse.clusters[c].size());
    for (const Index v : coarse.clusters[c]) ++held[v];
  }
  EXPECT_EQ(std::count(held.begin(), held.end(), 1), std::ssize(held));
}

TEST(Coarsen, LooksCloserWhereItIsThin) {
  const Mesh fine(plate_with_holes(400, 0.02), "plate");
  const CoarseMesh coarse = coarse_of(fine.view(), 600);
  EXPECT_LT(coarse.mesh.view().face_count(), 1200U);
  const RepairReport report = topology_of(coarse.mesh.view());
  ASSERT_EQ(report.holes, 5U);
  const double outline = 4 / coarse.mesh.view().mean_edge;
  EXPECT_GT(report.border_edges, 0.5 * outline + 4 * 9);  // nine around each hole at least
}

TEST(Coarsen, NumberOfFacesAndEvenness) {
  const Mesh fine(test::make_sphere(6), "sphere");  // 81,920 faces
  for (const std::size_t faces : {500, 2000, 8000}) {
    const MeshView coarse = coarse_of(fine.view(), faces).mesh.view();
    EXPECT_NEAR(coarse.face_count(), static_cast<double>(faces), 0.15 * static_cast<double>(faces));
  }
}

/// Radii of a unit sphere's coarse vertices: their mean less one, and their standard deviation.
std::array<double, 2> radii_of(const MeshView& mesh) {
  double sum = 0, squares = 0;
  for (const Vec3& p : mesh.positions) {
    sum += p.norm() - 1;
    squares += std::pow(p.norm() - 1, 2);
  }
  const double n = mesh.vertex_count(), mean = sum / n;
  return {mean, std::sqrt(squares / n - mean * mean)};
}

TEST(Coarsen, DoesNotShrinkWhatIsRound) {
  const Mesh fine(test::make_sphere(6), "sphere");
  const CoarseMesh coarse = coarse_of(fine.view(), 1000);
  double shrunk = 0;  // plain means of the clusters
  for (Index c = 0; c < coarse.clusters.size(); ++c) {
    Vec3 sum = Vec3::Zero();
    for (const Index v : coarse.clusters[c]) sum += fine.view().positions[v];
    shrunk += (1 - sum.norm() / static_cast<double>(coarse.clusters[c].size())) / coarse.clusters.size();
  }
  const auto [mean, sd] = radii_of(coarse.mesh.view());
  EXPECT_GT(shrunk, 1e-3);
  EXPECT_LT(std::abs(mean), shrunk / 10);
  EXPECT_LT(sd, shrunk / 4);
}

TEST(Coarsen, AveragesNoise) {
  TriangleSoup soup = test::make_sphere(6);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  for (Vec3& p : soup.positions) p *= 1 + noise(random);
  const Mesh fine(std::move(soup), "sphere");
  const CoarseMesh coarse = coarse_of(fine.view(), 1000);
  const double points = fine.view().vertex_count() / static_cast<double>(coarse.clusters.size());
  EXPECT_LT(radii_of(coarse.mesh.view())[1], 1.5 * 0.01 / std::sqrt(points));
}

TEST(Coarsen, OrderOfVerticesAndThreadsDoNotMatter) {
  const TriangleSoup soup = plate_with_holes(120, 0.02);
  const Mesh here(soup, "here"), there(test::shuffled(soup, 3), "there");
  const CoarseMesh a = coarse_of(here.view(), 800), b = coarse_of(there.view(), 800),
                   c = coarse_of(here.view(), 800, 4);
  EXPECT_TRUE(std::ranges::equal(a.mesh.view().triangles, b.mesh.view().triangles));
  ASSERT_EQ(a.mesh.view().vertex_count(), b.mesh.view().vertex_count());
  for (Index v = 0; v < a.mesh.view().vertex_count(); ++v)
    EXPECT_LT((a.mesh.view().positions[v] - b.mesh.view().positions[v]).norm(), 1e-12);
  EXPECT_TRUE(std::ranges::equal(a.mesh.view().triangles, c.mesh.view().triangles));
  EXPECT_TRUE(std::ranges::equal(a.mesh.view().positions, c.mesh.view().positions));
}

TEST(Coarsen, LeavesAloneWhatIsCoarse) {
  const Mesh sphere(test::make_sphere(3), "sphere");
  EXPECT_FALSE(coarsen(sphere.view(), sphere.view().face_count() / 2, test::context()));
  // A box of long triangles has no vertex to spare.
  const Mesh box(test::make_box({1, 1, 1}, 1), "box");
  EXPECT_FALSE(coarsen(box.view(), 4, test::context()));
}

}  // namespace
}  // namespace toposcope
