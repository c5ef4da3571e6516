// SPDX-License-Identifier: BSD-3-Clause

// First moments against what integration gives on a plane, a sphere, a right-angled edge and the edge of a thin sheet.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh/mesh.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "toposcope/geometry/curvature.h"

namespace toposcope {
namespace {

constexpr double half_disc = 16 / (15 * pi);  ///< its weighted mean's distance from the diameter, in radii

/// The vertex nearest to a point.
Index nearest(const Mesh& mesh, const Vec3& point) {
  Index best = 0;
  for (Index v = 1; v < mesh.view().vertex_count(); ++v)
    if ((mesh.view().positions[v] - point).squaredNorm() < (mesh.view().positions[best] - point).squaredNorm())
      best = v;
  return best;
}

constexpr double reach = 6, coarseness = 0.05;  ///< sums over a hundred vertices stand for integrals

TEST(FirstMoments, VanishInAPlane) {
  const Mesh mesh(test::make_grid(30, 30), "plane");
  const std::vector<Vec3> moments = first_moments(mesh.view(), 3, test::context(2));
  EXPECT_LT(moments[nearest(mesh, mesh.view().box.center)].norm(), 1e-12);
}

TEST(FirstMoments, OfASpherePointsInwardByASixthOfTheRatioOfRadii) {
  const Mesh mesh(test::make_sphere(4, 2.0), "sphere");
  const MeshView& view = mesh.view();
  const std::vector<Vec3> moments = first_moments(view, reach, test::context(2));
  const double expected = reach * view.mean_edge / (6 * 2.0);
  double sum = 0;
  for (Index v = 0; v < view.vertex_count(); ++v) {
    const double inward = -moments[v].dot(view.positions[v].normalized());
    EXPECT_NEAR(inward, expected, 4 * coarseness * expected);
    sum += inward / view.vertex_count();
  }
  EXPECT_NEAR(sum, expected, coarseness * expected);
}

TEST(FirstMoments, OfARightAngledEdgePointsIntoIt) {
  const Mesh mesh(test::make_box({4, 4, 4}, 32), "box");
  const MeshView& view = mesh.view();
  const std::vector<Vec3> moments = first_moments(view, reach, test::context(2));
  Vec3 corner = view.box.center;
  corner += 2 * Vec3::UnitX() + 2 * Vec3::UnitY();
  const Vec3 expected = -half_disc / 2 * (Vec3::UnitX() + Vec3::UnitY());
  EXPECT_LT((moments[nearest(mesh, corner)] - expected).norm(), coarseness * expected.norm());
}

/// Where curvature fails: the sheet is a tenth of an edge thick, and normals at its edge are of no use.
TEST(FirstMoments, OfAThinSheetsEdgePointIntoTheSheet) {
  const double edge = 4.0 / 32;
  const Mesh mesh(test::make_sheet(4, edge / 10, 32), "sheet");
  const MeshView& view = mesh.view();
  const std::vector<Vec3> moments = first_moments(view, reach, test::context(2));
  const Vec3 middle = view.box.center;
  const Vec3 at_edge = moments[nearest(mesh, middle + 2 * Vec3::UnitX() + edge / 20 * Vec3::UnitZ())];
  EXPECT_NEAR(at_edge.x(), -half_disc, coarseness * half_disc);
  EXPECT_LT(moments[nearest(mesh, middle + edge / 20 * Vec3::UnitZ())].norm(), 0.01);
}

TEST(FirstMoments, TurnWithTheMeshAndAreFreeOfItsUnit) {
  const TriangleSoup soup = test::make_torus(2, 0.6, 40, 20);
  const Eigen::Matrix3d turn = test::random_rotation(5);
  const Mesh mesh(soup, "torus"), moved(test::transformed(soup, turn, 25.4, Vec3(3, -8, 1)), "moved");
  const std::vector<Vec3> moments = first_moments(mesh.view(), 3, test::context(2));
  const std::vector<Vec3> there = first_moments(moved.view(), 3, test::context(1));
  for (Index v = 0; v < mesh.view().vertex_count(); ++v) EXPECT_LT((there[v] - turn * moments[v]).norm(), 1e-9) << v;
}

}  // namespace
}  // namespace toposcope
