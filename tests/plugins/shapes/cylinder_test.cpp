// SPDX-License-Identifier: BSD-3-Clause
#include "surface_fixture.h"
#include "toposcope/geometry/lines.h"

namespace toposcope::test {
namespace {

/// Greatest difference from the cylinder about the line through `point`, in radii.
double error(const FittedShape& shape, const Vec3& point, const Vec3& axis, double radius) {
  const Vec3 off = vector_parameter(shape, "point") - point;
  return std::max({(off - off.dot(axis) * axis).norm() / radius, line_angle(vector_parameter(shape, "axis"), axis),
                   std::abs(number_parameter(shape, "radius") - radius) / radius});
}

TEST(Cylinder, RecoversExactCylinders) {
  for (const double turn : {2 * pi, pi, 2 * pi / 3})
    for (const double length : {20.0, 6.0, 2.0}) {
      Random random(7);
      const Eigen::Matrix3d rotation = random.rotation();
      const Vec3 shift(3, -20, 11);
      const FittedShape fitted =
          fit(*shape("cylinder"), transformed(cylinder_points(5, length, turn, 400), rotation, 2, shift));
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      EXPECT_LT(error(fitted, shift, rotation.col(2), 10), 1e-9) << turn << " " << length;
      EXPECT_EQ(fitted.orientation, Orientation::line_like);
      EXPECT_EQ(fitted.unexplained, 0);
      EXPECT_NEAR(fitted.coverage, turn / (2 * pi), 0.05);
      EXPECT_NEAR(measure(fitted, "length").value, 2 * length, 0.05 * 2 * length);
      EXPECT_NEAR(measure(fitted, "area").value, turn * 10 * 2 * length, 1e-6 * turn * 20 * length);
      EXPECT_LT((fitted.centroid - shift).norm(), 0.05 * length);
    }
}

TEST(Cylinder, OutliersDoNotMoveIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double turn : {2 * pi, 2 * pi / 3}) {
      const PointSets sets = with_outliers(cylinder_points(10, 25, turn, 500, 0.05, seed), 0.3, seed);
      const FittedShape fitted = fit(*shape("cylinder"), sets);
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      EXPECT_LT(10 * error(fitted, Vec3::Zero(), Vec3::UnitZ(), 10), 0.15) << seed << " " << turn;
      EXPECT_GT(fitted.unexplained, 3);
    }
}

TEST(Cylinder, UncertaintyIsCalibrated) {
  for (const double turn : {2 * pi, 2 * pi / 3}) {  // a third of a cylinder
    Calibration radius, tilt, offset;
    double mean = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const FittedShape fitted = fit(*shape("cylinder"), cylinder_points(8, 20, turn, 250, 0.1, seed));
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      radius.add(number_parameter(fitted, "radius") - 8, measure(fitted, "radius").sd);
      mean += number_parameter(fitted, "radius") / 200;
      const Vec3 axis = vector_parameter(fitted, "axis"), point = vector_parameter(fitted, "point");
      for (int k = 0; k < 2; ++k) {
        tilt.add(axis[k], std::sqrt(fitted.covariance[static_cast<std::size_t>(3 + k) * 8]));
        const double moved = point[k] - axis[k] / axis.z() * point.z();  // where the axis meets z = 0
        offset.add(moved, std::sqrt(fitted.covariance[static_cast<std::size_t>(k) * 8]));
      }
    }
    expect_calibrated(radius, "radius");
    expect_calibrated(tilt, "axis");
    expect_calibrated(offset, "point");
    EXPECT_NEAR(mean, 8, turn > 6 ? 0.005 : 0.02);
  }
}

TEST(Cylinder, UncertaintyMeetsTheCramerRaoBound) {
  // Whole turn, n points with noise s: sd(radius) = s / sqrt(n), sd(offset) = s sqrt(2 / n), sd(tilt) = that over the
  // spread along the axis, length / sqrt(12).
  const double noise = 0.02, n = 2000;
  const FittedShape fitted = fit(*shape("cylinder"), cylinder_points(3, 12, 2 * pi, 2000, noise));
  EXPECT_NEAR(measure(fitted, "radius").sd, noise / std::sqrt(n), 0.1 * noise / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(fitted.covariance[0]), noise * std::sqrt(2 / n), 0.1 * noise * std::sqrt(2 / n));
  const double tilt = noise * std::sqrt(2 / n) / (12 / std::sqrt(12));
  EXPECT_NEAR(fitted.direction_sd, tilt, 0.1 * tilt);
}

TEST(Cylinder, DoesNotDependOnPoseScaleOrOrder) {
  expect_pose_scale_and_order_do_not_matter(*shape("cylinder"),
                                            with_outliers(cylinder_points(10, 30, 4, 900, 0.1), 0.1, 3));
}

TEST(Cylinder, TwoRunsOnTwoThreadsGiveTheSameBits) {
  expect_same_bits_on_another_thread(*shape("cylinder"), with_outliers(cylinder_points(10, 30, 4, 300, 0.1), 0.1, 3));
}

TEST(Cylinder, DegeneratePointsAreRefusedWithAReason) {
  expect_degenerate_points_are_refused(*shape("cylinder"));
}

TEST(Cylinder, DistanceBoundsAndOutline) {
  for (const double turn : {2 * pi, 2.0})
    expect_sound(*shape("cylinder"), cylinder_points(4, 10, turn, 150), cylinder_points(4, 80, 2 * pi, 60000).points,
                 0.5);
}

}  // namespace
}  // namespace toposcope::test
