// SPDX-License-Identifier: BSD-3-Clause
#include "surface_fixture.h"
#include "toposcope/geometry/lines.h"

namespace toposcope::test {
namespace {

/// Greatest difference, lengths in radii of the tube.
double error(const FittedShape& shape, const Vec3& center, const Vec3& axis, double major, double minor) {
  return std::max({(vector_parameter(shape, "center") - center).norm() / minor,
                   line_angle(vector_parameter(shape, "axis"), axis),
                   std::abs(number_parameter(shape, "major_radius") - major) / minor,
                   std::abs(number_parameter(shape, "minor_radius") - minor) / minor});
}

TEST(Torus, RecoversExactTori) {
  for (const double turn : {2 * pi, pi, pi / 2})
    for (const double around : {2 * pi, pi})
      for (const double minor : {1.0, 3.0}) {
        Random random(7);
        const Eigen::Matrix3d rotation = random.rotation();
        const Vec3 shift(3, -20, 11);
        const FittedShape fitted =
            fit(*shape("torus"), transformed(torus_points(5, minor, turn, around, 600), rotation, 2, shift));
        ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message << turn << " " << around << " " << minor;
        EXPECT_LT(error(fitted, shift, rotation.col(2), 10, 2 * minor), 1e-8) << turn << " " << around << " " << minor;
        EXPECT_EQ(fitted.orientation, Orientation::plane_like);
        EXPECT_EQ(fitted.unexplained, 0);
        if (around > 6) {
          EXPECT_NEAR(fitted.coverage, turn / (2 * pi), 1e-6);
        }
      }
}

TEST(Torus, OutliersDoNotMoveIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double turn : {2 * pi, pi / 2}) {  // a ring, and an elbow
      const PointSets sets = with_outliers(torus_points(10, 4, turn, 2 * pi, 700, 0.03, seed), 0.3, seed);
      const FittedShape fitted = fit(*shape("torus"), sets);
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      EXPECT_LT(error(fitted, Vec3::Zero(), Vec3::UnitZ(), 10, 4), 0.05) << seed << " " << turn;
      EXPECT_GT(fitted.unexplained, 3);
    }
}

TEST(Torus, UncertaintyIsCalibrated) {
  for (const double turn : {2 * pi, pi / 2}) {
    Calibration major, minor, tilt, center;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const FittedShape fitted = fit(*shape("torus"), torus_points(10, 4, turn, 2 * pi, 350, 0.1, seed));
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      major.add(number_parameter(fitted, "major_radius") - 10, measure(fitted, "major_radius").sd);
      minor.add(number_parameter(fitted, "minor_radius") - 4, measure(fitted, "minor_radius").sd);
      const Vec3 axis = vector_parameter(fitted, "axis"), c = vector_parameter(fitted, "center");
      for (int k = 0; k < 3; ++k) {
        if (k < 2) tilt.add(axis[k], std::sqrt(fitted.covariance[static_cast<std::size_t>(3 + k) * 9]));
        center.add(c[k], std::sqrt(fitted.covariance[static_cast<std::size_t>(k) * 9]));
      }
    }
    expect_calibrated(major, "ring");
    expect_calibrated(minor, "tube");
    expect_calibrated(tilt, "axis");
    expect_calibrated(center, "centre");
  }
}

TEST(Torus, SpheresAndCylindersAreRefused) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    EXPECT_FALSE(fit(*shape("torus"), sphere_points(8, pi, 300, 0.1, seed)).summary.usable()) << seed;
    EXPECT_FALSE(fit(*shape("torus"), cylinder_points(8, 20, 2 * pi, 300, 0.1, seed)).summary.usable()) << seed;
  }
}

TEST(Torus, DoesNotDependOnPoseScaleOrOrder) {
  expect_pose_scale_and_order_do_not_matter(*shape("torus"),
                                            with_outliers(torus_points(10, 4, 3, 2 * pi, 900, 0.05), 0.1, 3));
}

TEST(Torus, TwoRunsOnTwoThreadsGiveTheSameBits) {
  expect_same_bits_on_another_thread(*shape("torus"), with_outliers(torus_points(10, 4, 3, 2 * pi, 300, 0.1), 0.1, 3));
}

TEST(Torus, DegeneratePointsAreRefusedWithAReason) {
  expect_degenerate_points_are_refused(*shape("torus"));
}

TEST(Torus, DistanceBoundsAndOutline) {
  expect_sound(*shape("torus"), torus_points(6, 2, 2 * pi, 2 * pi, 300),
               torus_points(6, 2, 2 * pi, 2 * pi, 60000).points, 0.3);
  expect_sound(*shape("torus"), torus_points(6, 2, 2, 2 * pi, 300), torus_points(6, 2, 2 * pi, 2 * pi, 60000).points,
               0.3);
}

}  // namespace
}  // namespace toposcope::test
