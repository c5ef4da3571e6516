// SPDX-License-Identifier: BSD-3-Clause

// The default curvature estimate against surfaces whose curvature is known, and its parts against brute force.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "mesh/mesh.h"
#include "support/analytic_surfaces.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "toposcope/geometry/curvature.h"

namespace toposcope {
namespace {

using test::Sampling;

Curvature estimate(const MeshView& mesh, int passes, unsigned threads = 2) {
  ShapeOperators operators = fit_shape_operators(mesh, test::context(threads));
  diffuse(mesh, operators, passes, test::context(threads));
  return principal_curvatures(operators);
}

double quantile(std::vector<double> values, double part) {
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Errors of both principal curvatures, relative to the larger magnitude.
struct Errors {
  std::vector<double> larger, smaller;
};
Errors errors(const test::AnalyticSurface& surface, const Curvature& curvature) {
  Errors result;
  for (std::size_t v = 0; v < surface.maximum.size(); ++v) {
    if (!surface.interior[v]) continue;
    const double size = std::max(std::abs(surface.maximum[v]), std::abs(surface.minimum[v]));
    double big = std::abs(curvature.maximum[v] - surface.maximum[v]) / size;
    double small = std::abs(curvature.minimum[v] - surface.minimum[v]) / size;
    if (std::abs(surface.maximum[v]) < std::abs(surface.minimum[v])) std::swap(big, small);
    result.larger.push_back(big);
    result.smaller.push_back(small);
  }
  return result;
}

TEST(TangentFrame, IsOrthonormalAndRightHanded) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vec3> normals = {Vec3::UnitZ(), -Vec3::UnitZ(), Vec3::UnitX(), Vec3(0, 1e-9, -1).normalized()};
  for (int i = 0; i < 100; ++i) normals.push_back(Vec3(normal(random), normal(random), normal(random)).normalized());
  for (const Vec3& n : normals) {
    const auto [u, v] = tangent_frame(n);
    EXPECT_NEAR(u.norm(), 1, 1e-12);
    EXPECT_NEAR((u.cross(v) - n).norm(), 0, 1e-12) << n.transpose();
  }
}

TEST(VertexNormals, AreExactOnASphereHoweverIrregular) {
  const auto surface = test::make_surface("sphere", 2000, Sampling::irregular, 0, 5);
  const Mesh mesh(surface.mesh, "sphere");
  const auto normals = vertex_normals(mesh.view(), test::context());
  for (Index v = 0; v < mesh.view().vertex_count(); ++v)
    if (surface.interior[v]) {
      EXPECT_NEAR((normals[v] - mesh.view().positions[v]).norm(), 0, 1e-9);
    }
}

struct Case {
  const char* kind;
  double larger, smaller;  ///< bounds of the median errors
};

class OnAnalyticSurfaces : public ::testing::TestWithParam<Case> {};

TEST_P(OnAnalyticSurfaces, IsAccurateOnIrregularMeshes) {
  const auto [kind, larger, smaller] = GetParam();
  const auto surface = test::make_surface(kind, 20000, Sampling::irregular, 0, 1);
  const Mesh mesh(surface.mesh, kind);
  const Errors found = errors(surface, estimate(mesh.view(), 4));
  EXPECT_LT(quantile(found.larger, 0.5), larger);
  EXPECT_LT(quantile(found.smaller, 0.5), smaller);
  EXPECT_LT(quantile(found.larger, 0.95), 4 * larger);
}

INSTANTIATE_TEST_SUITE_P(ShapeOperators, OnAnalyticSurfaces,
                         ::testing::Values(Case{"sphere", 0.002, 0.002}, Case{"cylinder", 0.002, 0.002},
                                           Case{"torus", 0.006, 0.01}, Case{"saddle", 0.006, 0.006}),
                         [](const auto& instance) { return instance.param.kind; });

TEST(ShapeOperators, StayAccurateUnderNoise) {
  const auto surface = test::make_surface("torus", 20000, Sampling::irregular, 0.05, 1);
  const Mesh mesh(surface.mesh, "torus");
  EXPECT_LT(quantile(errors(surface, estimate(mesh.view(), 4)).larger, 0.5), 0.04);
  // Without diffusion the noise is several times as large: it is the diffusion that takes it away.
  EXPECT_GT(quantile(errors(surface, estimate(mesh.view(), 0)).larger, 0.5), 0.08);
}

TEST(ShapeOperators, AreNotFooledBySchwarzsLantern) {
  const auto lantern = test::make_lantern(40, 1600);  // bands = around^2: the faces' normals stay off for ever
  const Mesh mesh(lantern.mesh, "lantern");
  const Errors found = errors(lantern, estimate(mesh.view(), 4));
  EXPECT_LT(quantile(found.larger, 0.95), 0.01);
  EXPECT_LT(quantile(found.smaller, 0.95), 0.01);
}

TEST(ShapeOperators, DiffusionDoesNotFlattenWhatBendsEvenly) {
  const auto cylinder = test::make_surface("cylinder", 8000, Sampling::regular, 0, 1);
  const Mesh mesh(cylinder.mesh, "cylinder");
  const MeshView& view = mesh.view();
  const Curvature before = estimate(view, 0), after = estimate(view, 60);
  Index middle = 0;  // far from both borders
  for (Index v = 0; v < view.vertex_count(); ++v)
    if (std::abs(view.positions[v].z()) < std::abs(view.positions[middle].z())) middle = v;
  EXPECT_NEAR(before.maximum[middle], 1, 0.003);
  EXPECT_NEAR(after.maximum[middle], before.maximum[middle], 1e-3);
  EXPECT_NEAR(after.minimum[middle], before.minimum[middle], 1e-3);
}

/// One pass against 3 x 3 tensors rotated by the quaternion between the normals.
TEST(ShapeOperators, AreCarriedByTheRotationBetweenTheNormals) {
  const auto surface = test::make_surface("torus", 1000, Sampling::irregular, 0.05, 2);
  const Mesh mesh(surface.mesh, "torus");
  const MeshView& view = mesh.view();
  const ShapeOperators before = fit_shape_operators(view, test::context());
  ShapeOperators after = before;
  diffuse(view, after, 1, test::context());
  const Curvature found = principal_curvatures(after);
  const auto tensor = [&](Index v) -> Eigen::Matrix3d {
    const auto [u, w] = tangent_frame(before.normals[v]);
    const auto& [mean, x, y] = before.at[v];
    return (mean + x) * u * u.transpose() + (mean - x) * w * w.transpose() +
           y * (u * w.transpose() + w * u.transpose());
  };
  for (Index p = 0; p < view.vertex_count(); ++p) {
    Eigen::Matrix3d sum = tensor(p);
    for (Index q : view.one_ring(p)) {
      const Eigen::Matrix3d turn =
          Eigen::Quaterniond::FromTwoVectors(before.normals[q], before.normals[p]).toRotationMatrix();
      sum += turn * tensor(q) * turn.transpose();
    }
    sum /= static_cast<double>(view.one_ring(p).size() + 1);
    const auto [u, w] = tangent_frame(before.normals[p]);
    Eigen::Matrix2d form;
    form << u.dot(sum * u), u.dot(sum * w), w.dot(sum * u), w.dot(sum * w);
    const Eigen::Vector2d eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(form).eigenvalues();
    EXPECT_NEAR(found.minimum[p], eigenvalues[0], 1e-5);
    EXPECT_NEAR(found.maximum[p], eigenvalues[1], 1e-5);
  }
}

TEST(ShapeOperators, TurnWithTheMeshAndChangeSignWithTheSide) {
  TriangleSoup soup = test::make_surface("torus", 2000, Sampling::irregular, 0.02, 4).mesh;
  const Mesh mesh(soup, "torus");
  const Mesh moved(test::transformed(soup, test::random_rotation(9), 1000, Vec3(3, -2, 1)), "moved");
  for (Triangle& t : soup.triangles) std::swap(t[1], t[2]);
  const Mesh turned(soup, "turned");
  const Curvature here = estimate(mesh.view(), 3), there = estimate(moved.view(), 3),
                  inside = estimate(turned.view(), 3);
  for (Index v = 0; v < mesh.view().vertex_count(); ++v) {
    EXPECT_NEAR(1000 * there.maximum[v], here.maximum[v], 1e-5);
    EXPECT_NEAR(1000 * there.minimum[v], here.minimum[v], 1e-5);
    EXPECT_NEAR(-inside.minimum[v], here.maximum[v], 1e-5);
  }
}

TEST(ShapeOperators, AreTheSameAtAnyThreadCount) {
  const Mesh mesh(test::make_surface("torus", 20000, Sampling::irregular, 0.1, 6).mesh, "torus");
  const Curvature one = estimate(mesh.view(), 5, 1), three = estimate(mesh.view(), 5, 3);
  EXPECT_EQ(one.maximum, three.maximum);
  EXPECT_EQ(one.minimum, three.minimum);
}

TEST(ShapeOperators, OfScrapsAreFinite) {
  TriangleSoup scraps;  // one triangle, a vertex without faces, two vertices at one place
  scraps.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {3, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  scraps.triangles = {{0, 1, 2}, {4, 5, 6}};
  scraps.face_origin = {0, 1};
  scraps.input_faces = 2;
  const Mesh mesh(scraps, "scraps");
  const Curvature curvature = estimate(mesh.view(), 2);
  for (Index v = 0; v < mesh.view().vertex_count(); ++v) {
    EXPECT_NEAR(curvature.maximum[v], 0, 1e-9);
    EXPECT_NEAR(curvature.minimum[v], 0, 1e-9);
  }
}

TEST(DiffusionPasses, FollowDeviationAndEdge) {
  const Mesh mesh(test::make_sphere(3), "sphere");
  const MeshView& view = mesh.view();
  EXPECT_EQ(diffusion_passes(view, 0, 1), 1);
  EXPECT_EQ(diffusion_passes(view, std::sqrt(0.43 * 5) * view.mean_edge, 1), 5);
  EXPECT_EQ(diffusion_passes(view, 100 * view.mean_edge, 1), 8);
}

}  // namespace
}  // namespace toposcope
