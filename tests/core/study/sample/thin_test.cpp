// SPDX-License-Identifier: BSD-3-Clause
#include "sample/thin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/run_context.h"
#include "mesh/mesh.h"
#include "sample/isosurface.h"
#include "support/meshes.h"

namespace toposcope {
namespace {

TEST(Thin, KeepsTopologyBorderAndShape) {
  struct Sink final : MeshSink {
    TriangleSoup mesh;
    void set(std::span<const Vec3> positions, std::span<const Triangle> triangles, std::span<const Index> origin,
             std::span<const Index>) override {
      mesh.positions.assign(positions.begin(), positions.end());
      mesh.triangles.assign(triangles.begin(), triangles.end());
      mesh.face_origin.assign(origin.begin(), origin.end());
    }
  };
  RunContext context({.threads = 1});
  const auto thinned = [&](TriangleSoup soup, Index faces) {
    soup.input_faces = static_cast<Index>(soup.triangles.size());
    soup.face_origin.clear();
    for (Index f = 0; f < soup.input_faces; ++f) soup.face_origin.push_back(f);
    const Mesh mesh(std::move(soup), "test");
    Sink sink;
    Thin(faces).apply(mesh.view(), context, sink);
    return sink.mesh;
  };
  const TriangleSoup torus = thinned(test::make_torus(1, 0.4, 120, 60), 4000);
  EXPECT_TRUE(is_closed_manifold(torus));
  EXPECT_EQ(torus.positions.size() * 2, torus.triangles.size()) << "genus 1";
  EXPECT_NEAR(static_cast<double>(torus.triangles.size()), 4000, 2);
  for (const Triangle& t : torus.triangles) {
    const Vec3 center = (torus.positions[t[0]] + torus.positions[t[1]] + torus.positions[t[2]]) / 3;
    const double ring = std::hypot(center.x(), center.y()) - 1;
    EXPECT_NEAR(std::hypot(ring, center.z()), 0.4, 0.02);
  }
  // A plate keeps every vertex of its border.
  const TriangleSoup plate = thinned(test::make_grid(30, 30, 3, 3), 900);
  EXPECT_LE(plate.triangles.size(), 900U);
  std::size_t border = 0;
  for (const Vec3& p : plate.positions) border += std::max(std::abs(p.x()), std::abs(p.y())) > 1.5 - 1e-9 ? 1 : 0;
  EXPECT_EQ(border, 120U);
  // Nothing to do: the sink is not called.
  EXPECT_TRUE(thinned(test::make_sphere(2), 400).triangles.empty());
}

}  // namespace
}  // namespace toposcope
