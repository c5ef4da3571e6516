// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/run_context.h"
#include "mesh/mesh.h"
#include "support/meshes.h"

namespace toposcope {
namespace {

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

TEST(PlaneFitNormals, OfASphereAreRadial) {
  RunContext context;
  const Mesh mesh(test::make_sphere(4), "sphere");
  const auto normals = plane_fit_normals(mesh.view(), context);
  for (Index v = 0; v < mesh.view().vertex_count(); ++v)
    EXPECT_GT(normals[v].dot(mesh.view().positions[v].normalized()), std::cos(0.01));
}

TEST(TurningCurvature, OfASphereIsOneOverRadius) {
  RunContext context;
  const Mesh mesh(test::make_sphere(4), "sphere");
  const auto curvature = turning_curvature(mesh.view(), plane_fit_normals(mesh.view(), context), 2, context);
  // The extremes over a neighbourhood: the estimate errs outwards, by the irregularity of the mesh.
  EXPECT_NEAR(median(curvature.maximum), 1, 0.06);
  EXPECT_NEAR(median(curvature.minimum), 1, 0.06);
  EXPECT_GE(median(curvature.maximum), median(curvature.minimum));
}

TEST(TurningCurvature, ChangesSignWithTheSideAndScalesInversely) {
  RunContext context;
  TriangleSoup soup = test::make_torus(2, 0.5, 96, 48);
  const Mesh mesh(soup, "torus");
  const auto outside = turning_curvature(mesh.view(), plane_fit_normals(mesh.view(), context), 2, context);
  for (Vec3& p : soup.positions) p *= 1000;  // the dissertation's own sign test fails here
  for (Triangle& t : soup.triangles) std::swap(t[1], t[2]);
  const Mesh turned(soup, "torus");
  const auto inside = turning_curvature(turned.view(), plane_fit_normals(turned.view(), context), 2, context);
  for (Index v = 0; v < mesh.view().vertex_count(); ++v) {
    EXPECT_NEAR(outside.maximum[v], -inside.minimum[v] * 1000, 1e-6);
    EXPECT_NEAR(outside.minimum[v], -inside.maximum[v] * 1000, 1e-6);
  }
  EXPECT_NEAR(median(outside.maximum), 2, 0.1);
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Of a convex body this is half of 4 pi times its mean width (Steiner): 3 pi a for a cube, 4 pi r for a sphere.
TEST(MeanCurvatureMeasure, OfConvexBodiesIsTheirMeanWidth) {
  for (const int n : {1, 4}) {
    const Mesh cube(test::make_box({2, 2, 2}, n), "cube");
    EXPECT_NEAR(sum(mean_curvature_measure(cube.view())), 3 * pi * 2, 1e-9) << "whatever the triangles";
  }
  const Mesh sphere(test::make_sphere(4), "sphere");
  EXPECT_NEAR(sum(mean_curvature_measure(sphere.view())), 4 * pi, 0.02);
  const Mesh box(test::transformed(test::make_box({1, 2, 5}), test::random_rotation(3), 10, {1, 2, 3}), "box");
  EXPECT_NEAR(sum(mean_curvature_measure(box.view())), 10 * (1 + 2 + 5) * pi, 1e-9) << "a length";
}

TEST(MeanCurvatureMeasure, LiesWhereTheSurfaceBendsAndHasItsSign) {
  TriangleSoup soup = test::make_box({4, 4, 4}, 4);
  const Mesh cube(soup, "cube");
  const std::vector<double> outside = mean_curvature_measure(cube.view());
  for (Index v = 0; v < cube.view().vertex_count(); ++v) {
    const int on_faces = static_cast<int>((cube.view().positions[v].cwiseAbs().array() > 2 - 1e-9).count());
    // Each edge of length 1 has 1 * (pi / 2) / 4 for each of its ends.
    EXPECT_NEAR(outside[v], on_faces == 1 ? 0 : on_faces == 2 ? 2 * pi / 8 : 3 * pi / 8, 1e-9);
  }
  for (Triangle& t : soup.triangles) std::swap(t[1], t[2]);
  const Mesh room(soup, "room");
  const std::vector<double> inside = mean_curvature_measure(room.view());
  for (Index v = 0; v < room.view().vertex_count(); ++v) EXPECT_NEAR(inside[v], -outside[v], 1e-9);
  const Mesh sheet(test::make_grid(3, 3), "sheet");
  for (const double x : mean_curvature_measure(sheet.view())) EXPECT_EQ(x, 0) << "a border is no bend";
}

TEST(SmoothOverRing, KeepsAConstantAndAverages) {
  RunContext context;
  const Mesh mesh(test::make_sphere(2), "sphere");
  std::vector<double> constant(mesh.view().vertex_count(), 3.5);
  smooth_over_ring(mesh.view(), constant, 5, context);
  for (double value : constant) EXPECT_NEAR(value, 3.5, 1e-12);
  std::vector<double> spike(mesh.view().vertex_count(), 0);
  spike[0] = 1;
  smooth_over_ring(mesh.view(), spike, 1, context);
  EXPECT_NEAR(spike[0], 1.0 / static_cast<double>(mesh.view().one_ring(0).size() + 1), 1e-12);
}

TEST(SurfaceArea, OfASphere) {
  const Mesh mesh(test::make_sphere(5), "sphere");
  EXPECT_NEAR(surface_area(mesh.view()), 4 * pi, 0.02);
}

TEST(RingsWithin, FollowsTheResolution) {
  const Mesh coarse(test::make_sphere(2), "coarse"), fine(test::make_sphere(4), "fine");
  const double radius = 2.2 * coarse.view().mean_edge;
  EXPECT_EQ(rings_within(coarse.view(), radius), 2);
  EXPECT_GE(rings_within(fine.view(), radius), 7);
  EXPECT_EQ(rings_within(fine.view(), 0), 1);
}

}  // namespace
}  // namespace toposcope
