// SPDX-License-Identifier: BSD-3-Clause

// Round things of few faces: the vertices lie on them, what a filter puts between them does not. And what noise hides.

#include <numeric>

#include "pipeline/filters.h"
#include "support/meshes.h"
#include "surface_fixture.h"

namespace toposcope::test {
namespace {

/// A mesh whose long edges are split, and some of its vertices as what is fitted.
struct Refined {
  Mesh mesh;
  PreparedMesh prepared;
  std::vector<Vec3> points;
  std::vector<Index> vertices;

  template <class Wanted>
  Refined(TriangleSoup soup, const Wanted& wanted) : mesh(std::move(soup), "round"), prepared(refined()) {
    const MeshView& view = prepared.view();
    for (Index v = 0; v < view.vertex_count(); ++v)
      if (wanted(view.positions[v])) points.push_back(view.positions[v]), vertices.push_back(v);
  }
  explicit Refined(TriangleSoup soup) : Refined(std::move(soup), [](const Vec3&) { return true; }) {}
  PreparedMesh refined() const {
    const std::vector<FilterStation> filters = {{"refine", filter("refine", {{"max_edge", "0.03"}})}};
    return apply_filters(mesh, filters, context());
  }
  FittedShape fit(const char* kind) const {
    const MeshView& view = prepared.view();
    const std::vector<Index> offsets = {0, static_cast<Index>(points.size())};
    const Box box = oriented_box(points);
    const std::vector<Box> boxes = {box};
    // What a vertex stands for: a third of its triangles.
    std::vector<double> areas;
    for (const Index v : vertices) {
      areas.push_back(0);
      for (const Index f : view.faces_of(v)) {
        const auto& [a, b, c] = view.triangles[f];
        areas.back() += (view.positions[b] - view.positions[a]).cross(view.positions[c] - view.positions[a]).norm() / 6;
      }
    }
    const FitInput input{points, areas, offsets, boxes, box, view.box, view.mean_edge, {}, &view, vertices};
    return shape(kind)->fit(input, Options(), context());
  }
};

double sagitta(double radius, int segments) {
  return radius * (1 - std::cos(pi / segments));
}

TEST(Tessellations, CylindersHaveTheRadiusOfTheirVertices) {
  for (const int segments : {8, 10, 12, 16, 20, 32, 64, 96, 200}) {
    const Refined tube(make_cylinder(2, 5, segments, 1, false));
    const FittedShape fitted = tube.fit("cylinder");
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message << segments;
    const auto& [name, radius, sd] = measure(fitted, "radius");
    EXPECT_NEAR(radius, 2, 1e-6) << segments;
    // A polygon may also be meant; the deviation says what cannot be told, and no more than that.
    EXPECT_GT(sd, sagitta(2, segments) / 3) << segments;
    EXPECT_LT(sd, sagitta(2, segments)) << segments;
    EXPECT_LT(fitted.direction_sd, 1e-6);
  }
}

TEST(Tessellations, CirclesHaveTheRadiusOfTheirVertices) {
  for (const int segments : {8, 10, 12, 16, 20, 32, 64, 96, 200}) {
    const Refined ring(make_cylinder(2, 5, segments, 1, true),
                       [](const Vec3& p) { return p.z() > 2.4 && p.head<2>().norm() > 1.83; });
    const FittedShape fitted = ring.fit("circle");
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message << segments;
    const auto& [name, radius, sd] = measure(fitted, "radius");
    EXPECT_LT(std::abs(radius - 2), 0.3 * sd) << segments;
    EXPECT_NEAR(radius, 2, 1e-3) << segments;
    EXPECT_LT(sd, sagitta(2, segments) + 1e-3) << segments;
  }
}

TEST(Tessellations, SpheresAndToriHaveTheRadiiOfTheirVertices) {
  for (const int subdivisions : {1, 2, 3}) {
    const FittedShape fitted = Refined(make_sphere(subdivisions, 3)).fit("sphere");
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_NEAR(measure(fitted, "radius").value, 3, 1e-6);
    const double chord = 3 * 1.1 / (1 << subdivisions);  // edges of an icosahedron, cut in halves
    EXPECT_LT(measure(fitted, "radius").sd, chord * chord / 6);
    EXPECT_GT(measure(fitted, "radius").sd, chord * chord / 60);
  }
  for (const int segments : {12, 24}) {
    const FittedShape fitted = Refined(make_torus(4, 1, 2 * segments, segments)).fit("torus");
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_NEAR(measure(fitted, "major_radius").value, 4, 1e-6);
    EXPECT_NEAR(measure(fitted, "minor_radius").value, 1, 1e-6);
    EXPECT_GT(measure(fitted, "minor_radius").sd, sagitta(1, segments) / 3);
    EXPECT_LT(measure(fitted, "minor_radius").sd, sagitta(1, segments));
  }
}

TEST(Tessellations, FewVerticesOnOneSideDoNotOverruleAllPoints) {
  // Read vertices at one end and along one line of a tube's wall, moved off by noise: they do not determine it.
  const TriangleSoup soup = make_cylinder(2, 5, 90, 45, false);
  Refined tube(soup);
  ASSERT_TRUE(tube.prepared.view().input_vertices.empty());
  std::vector<Index> origin(tube.points.size(), no_vertex);
  for (std::size_t i = 0; i < origin.size(); ++i)
    if (std::abs(tube.points[i].y()) < 0.3 && tube.points[i].x() > 0) origin[i] = static_cast<Index>(i);
  MeshView view = tube.prepared.view();
  view.input_vertices = origin;
  const std::vector<Index> offsets = {0, static_cast<Index>(tube.points.size())};
  const Box box = oriented_box(tube.points);
  const std::vector<Box> boxes = {box};
  const std::vector<double> areas(tube.points.size(), 0.05);
  std::vector<Vec3> noisy = tube.points;
  Random random(1);
  for (Vec3& point : noisy) point += random.normal3(0.02);
  const FitInput input{noisy, areas, offsets, boxes, box, box, view.mean_edge, {}, &view, tube.vertices};
  const FittedShape fitted = shape("cylinder")->fit(input, Options(), context());
  ASSERT_TRUE(fitted.summary.usable());
  EXPECT_NEAR(measure(fitted, "radius").value, 2, 0.005);
}

TEST(Tessellations, WhatHasNoVertexOfTheFileIsAsUncertainAsChordsAreDeep) {
  for (const int segments : {12, 24, 48}) {
    const Refined middle(make_cylinder(2, 5, segments, 1, false), [](const Vec3& p) { return std::abs(p.z()) < 2.4; });
    const FittedShape fitted = middle.fit("cylinder");
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message << segments;
    const auto& [name, radius, sd] = measure(fitted, "radius");
    EXPECT_LT(std::abs(radius - 2), 2 * sd) << segments;
    EXPECT_LT(sd, 2 * sagitta(2, segments)) << segments;
  }
}

TEST(NoisyShapes, NoiseAlongTheSurfaceIsCovered) {
  // Moved every way, points lie farther out: by s^2 / r from a sphere's centre, by half of that from a circle's.
  Calibration sphere, circle, cylinder;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    PointSets ball = sphere_points(1, pi, 600, 0, seed), tube = cylinder_points(1, 4, 2 * pi, 600, 0, seed), ring;
    for (Vec3& point : ball.points) point += random.normal3(0.2);
    for (Vec3& point : tube.points) point += random.normal3(0.2);
    for (int i = 0; i < 300; ++i) {
      const double angle = 2 * pi * i / 300;
      ring.points.push_back(Vec3(std::cos(angle), std::sin(angle), 0) + random.normal3(0.2));
    }
    ring.mean_edge = 2 * pi / 300;
    // Wide enough a scale to take all of them in.
    const auto add = [](Calibration& to, const char* kind, const PointSets& sets, double edge) {
      PointSets wide = sets;
      wide.mean_edge = edge;
      const FittedShape fitted = fit(*shape(kind), wide);
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      to.add(measure(fitted, "radius").value - 1, measure(fitted, "radius").sd);
    };
    add(sphere, "sphere", ball, 0.3);
    add(cylinder, "cylinder", tube, 0.3);
    add(circle, "circle", ring, 0.3);
  }
  for (const Calibration* each : {&sphere, &circle, &cylinder}) EXPECT_LT(each->variance(), 1.6);
}

TEST(NoisyShapes, FlatArcsAreUncertainAndNotSmall) {
  for (const double turn : {pi / 9, pi / 6, pi / 4})
    for (const double noise : {0.5, 1.0, 2.0}) {  // sagittas
      int wrong = 0;
      const double sd = noise * (1 - std::cos(turn / 2));
      for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Random random(seed);
        PointSets arc;
        for (int i = 0; i < 40; ++i) {
          const double angle = turn * (i + 0.5) / 40;
          arc.points.push_back(Vec3(std::cos(angle), std::sin(angle), 0) + random.normal3(sd));
        }
        arc.mean_edge = turn / 40;
        const FittedShape fitted = fit(*shape("circle", {{"scale", "20"}}), arc);
        if (!fitted.summary.usable()) continue;
        wrong += std::abs(measure(fitted, "radius").value - 1) > 2 * measure(fitted, "radius").sd ? 1 : 0;
      }
      EXPECT_LE(wrong, 15) << turn << " " << noise;
    }
}

}  // namespace
}  // namespace toposcope::test
