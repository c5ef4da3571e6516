// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/meshes.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

/// A lattice, whose variance along each axis is known: spacing^2 (n^2 - 1) / 12.
std::vector<Vec3> lattice(int nx, int ny, int nz) {
  std::vector<Vec3> points;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) points.emplace_back(i, j, k);
  return points;
}

TEST(PrincipalAxes, OfALatticeInAnyPose) {
  const std::vector<Vec3> points = lattice(4, 9, 6);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    const Vec3 shift(1e5, -2e5, 3e5);
    std::vector<Vec3> moved;
    for (const Vec3& p : points) moved.push_back(rotation * p + shift);
    const PrincipalAxes axes = principal_axes(moved);
    EXPECT_NEAR((axes.centroid - (rotation * Vec3(1.5, 4, 2.5) + shift)).norm(), 0, 1e-9);
    const std::array<double, 3> variance = {80 / 12.0, 35 / 12.0, 15 / 12.0};
    const std::array<int, 3> column = {1, 2, 0};
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(axes.variance[i], variance[i], 1e-9);
      EXPECT_NEAR(std::abs(axes.axes[i].dot(rotation.col(column[i]))), 1, 1e-12);
    }
    EXPECT_NEAR(axes.axes[0].cross(axes.axes[1]).dot(axes.axes[2]), 1, 1e-12);
  }
}

TEST(PrincipalAxes, OfFlatLinearAndSinglePoints) {
  const PrincipalAxes flat = principal_axes(lattice(3, 5, 1));
  EXPECT_NEAR(flat.variance[2], 0, 1e-15);
  EXPECT_NEAR(std::abs(flat.axes[2].z()), 1, 1e-15);
  const PrincipalAxes linear = principal_axes(lattice(1, 5, 1));
  EXPECT_NEAR(linear.variance[0], 2, 1e-15);
  EXPECT_EQ(linear.variance[1], 0);
  const PrincipalAxes single = principal_axes(std::vector<Vec3>{{1, 2, 3}});
  EXPECT_EQ(single.centroid, Vec3(1, 2, 3));
  EXPECT_EQ(single.variance[0], 0);
  EXPECT_NEAR(single.axes[0].cross(single.axes[1]).dot(single.axes[2]), 1, 1e-15);
}

}  // namespace
}  // namespace toposcope
