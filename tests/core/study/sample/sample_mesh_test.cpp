// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>

#include "core/study/sample/sample_fixture.h"
#include "sample/isosurface.h"
#include "sample/solid.h"

namespace toposcope {
namespace {

using test::edges;
using test::Edges;
using test::make;
using test::value;
using test::vec;
using test::volume;

struct Case {
  const char* name;
  const char* kind;
  Index faces;
  std::map<std::string, double> parameters;
  long euler;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

void expect_good_mesh(const Sample& sample, const Solid& solid, const Case& c) {
  const TriangleSoup& mesh = sample.mesh;

  EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), c.faces, 0.03 * c.faces);
  std::set<std::pair<Index, Index>> directed;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(directed.emplace(t[i], t[(i + 1) % 3]).second);
  for (const auto& [a, b] : directed) EXPECT_TRUE(directed.count({b, a}));
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(static_cast<long>(mesh.positions.size()) - static_cast<long>(directed.size() / 2) +
                static_cast<long>(mesh.triangles.size()),
            c.euler);
  EXPECT_GT(volume(mesh), 0);

  const Edges e = edges(mesh);
  testing::Test::RecordProperty("edge_length_variation", std::to_string(e.variation));
  EXPECT_LT(e.variation, 0.45);
  for (const Vec3& p : mesh.positions) EXPECT_LT(std::abs(solid.surface(p).value), 1e-3 * e.mean);

  double quality = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
    const Vec3 area = (q - p).cross(r - p);
    const double shape =
        2 * std::sqrt(3.0) * area.norm() / ((q - p).squaredNorm() + (r - q).squaredNorm() + (p - r).squaredNorm());
    EXPECT_GT(shape, 0.2) << "1 for an equilateral triangle";
    quality += shape;
    const Vec3 normal = solid.surface(p).gradient + solid.surface(q).gradient + solid.surface(r).gradient;
    EXPECT_GT(area.dot(normal), 0) << "a face that looks inwards";
  }
  EXPECT_GT(quality / static_cast<double>(mesh.triangles.size()), 0.88);
}

void expect_truth_on_surface(const Sample& sample, const Solid& solid) {
  const double mean_edge = edges(sample.mesh).mean;
  for (const TruthFeature& f : sample.truth.features) {
    SCOPED_TRACE(f.name);
    ASSERT_EQ(f.points.size(), f.vertices.size());
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      EXPECT_LT(std::abs(solid.surface(f.points[i]).value), 1e-9 * mean_edge);
      EXPECT_LT((sample.mesh.positions[f.vertices[i]] - f.points[i]).norm(), 1.5 * mean_edge);
    }
    EXPECT_EQ(std::set<Index>(f.vertices.begin(), f.vertices.end()).size(), f.vertices.size());
    if (f.shape == "circle" && !f.points.empty()) {
      const Vec3 center = vec(value(f, "center")), normal = vec(value(f, "normal"));
      const double radius = value(f, "radius").front();
      EXPECT_GE(f.points.size(), 20U);
      for (const Vec3& p : f.points) {
        EXPECT_NEAR((p - center).norm(), radius, 1e-9 * radius);
        EXPECT_NEAR((p - center).dot(normal), 0, 1e-9 * radius);
      }
    }
  }
}

class SampleMesh : public testing::TestWithParam<Case> {};

TEST_P(SampleMesh, IsGoodAndLiesWithItsTruthOnTheExactSurface) {
  const Case& c = GetParam();
  const Sample sample = make({.kind = c.kind, .parameters = c.parameters, .faces = c.faces});
  const Solid solid = make_solid(c.kind, sample.parameters);
  expect_good_mesh(sample, solid, c);
  expect_truth_on_surface(sample, solid);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, SampleMesh,
    testing::Values(
        Case{"cup_2k", "cup", 2000, {}, 0}, Case{"cup_5k", "cup", 5000, {}, 0}, Case{"cup_20k", "cup", 20000, {}, 0},
        Case{"glass_5k", "cup", 5000, {{"handle", 0}}, 2},
        Case{"leaning_cup_5k", "cup", 5000, {{"top_radius", 50}, {"lip_radius", 1.2}}, 0},
        Case{"tee_2k", "tee", 2000, {}, -2}, Case{"tee_5k", "tee", 5000, {}, -2}, Case{"tee_20k", "tee", 20000, {}, -2},
        Case{"wye_5k", "wye", 5000, {}, -2}, Case{"cross_5k", "cross", 5000, {}, -4},
        Case{"elbow_5k", "elbow", 5000, {}, 0}, Case{"mitred_elbow_3k", "elbow", 3000, {{"mitred", 1}}, 0},
        Case{"tricorner_5k", "tricorner", 5000, {}, -2},
        Case{"socket_wye_5k",
             "wye",
             5000,
             {{"socket", 1}, {"run_length", 180}, {"branch_length", 120}, {"branch_angle", 60}},
             -2},
        Case{"socket_elbow_5k", "elbow", 5000, {{"socket", 1}, {"leg1_length", 60}, {"leg2_length", 55}}, 0},
        Case{"airplane_5k", "airplane", 5000, {}, 2}, Case{"airplane_10k", "airplane", 10000, {}, 2},
        Case{"t_tail_8k", "airplane", 8000, {{"t_tail", 1}, {"wing_height", 4}, {"wing_sweep", 30}}, 2},
        Case{"two_engines_8k", "airplane", 8000, {{"engines", 2}}, 2},
        Case{"four_engines_8k", "airplane", 8000, {{"engines", 4}, {"engine_drop", 1}}, 2},
        Case{"rear_engines_8k",
             "airplane",
             8000,
             {{"engines", 2}, {"engines_at_rear", 1}, {"engine_drop", 6}, {"wing_position", 28}},
             2},
        Case{"socket_tee_5k", "tee", 5000, {{"socket", 1}, {"run_length", 140}, {"branch_length", 70}}, -2}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Sample, EveryPresetIsAGoodMeshAndLiesWithItsTruthOnTheExactSurface) {
  for (const SampleKind& kind : sample_kinds())
    for (const SamplePreset& preset : kind.presets) {
      if (make_solid(kind.name, check_parameters(kind, {})).tessellate) continue;  // plate_test.cpp
      SCOPED_TRACE(kind.name + " " + preset.name);
      const Index faces = kind.name == "airplane" ? 10000 : 6000;
      const Sample sample = make({.kind = kind.name, .faces = faces, .preset = preset.name});
      const std::map<std::string, long> euler = {{"cup", 0},   {"tee", -2},       {"wye", -2},    {"cross", -4},
                                                 {"elbow", 0}, {"tricorner", -2}, {"airplane", 2}};
      const Solid solid = make_solid(kind.name, sample.parameters);
      expect_good_mesh(sample, solid, {"", kind.name.c_str(), faces, {}, euler.at(kind.name)});
      expect_truth_on_surface(sample, solid);
      EXPECT_EQ(sample.face_part.size(), sample.mesh.triangles.size());
    }
}

TEST(IsClosedManifold, TellsTheFaultsApart) {
  TriangleSoup mesh;
  mesh.positions.resize(7, Vec3::Zero());
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_TRUE(is_closed_manifold(mesh));
  TriangleSoup open = mesh;
  open.triangles.pop_back();
  EXPECT_FALSE(is_closed_manifold(open));
  TriangleSoup turned = mesh;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_FALSE(is_closed_manifold(turned));
  TriangleSoup pinched = mesh;  // a second tetrahedron that shares vertex 3 alone
  for (const Triangle& t : {Triangle{4, 6, 5}, Triangle{4, 5, 3}, Triangle{5, 6, 3}, Triangle{6, 4, 3}})
    pinched.triangles.push_back(t);
  EXPECT_FALSE(is_closed_manifold(pinched));
}

}  // namespace
}  // namespace toposcope
