// SPDX-License-Identifier: BSD-3-Clause
#include "surface_fixture.h"
#include "toposcope/geometry/lines.h"

namespace toposcope::test {
namespace {

constexpr double degrees = 180 / pi;

/// Difference in the angle and the axis (rad), and of the apex as part of its distance from the points.
double error(const FittedShape& shape, const Vec3& apex, const Vec3& axis, double half_angle, double away) {
  return std::max({(vector_parameter(shape, "apex") - apex).norm() / away,
                   line_angle(vector_parameter(shape, "axis"), axis),
                   std::abs(number_parameter(shape, "half_angle") / degrees - half_angle)});
}

TEST(Cone, RecoversExactCones) {
  for (const double angle : {5 / degrees, 30 / degrees, 75 / degrees})
    for (const double turn : {2 * pi, pi, 2 * pi / 3})
      for (const double low : {0.0, 4.0}) {
        Random random(7);
        const Eigen::Matrix3d rotation = random.rotation();
        const Vec3 shift(3, -20, 11);
        const FittedShape fitted =
            fit(*shape("cone"), transformed(cone_points(angle, low, 8, turn, 500), rotation, 2, shift));
        ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message << angle << " " << turn << " " << low;
        EXPECT_LT(error(fitted, shift, rotation.col(2), angle, 10), 1e-8) << angle << " " << turn << " " << low;
        EXPECT_GT(vector_parameter(fitted, "axis").dot(rotation.col(2)), 0) << "the axis runs into the cone";
        EXPECT_EQ(fitted.orientation, Orientation::line_like);
        EXPECT_EQ(fitted.unexplained, 0);
        EXPECT_NEAR(fitted.coverage, turn / (2 * pi), 0.08);
        EXPECT_NEAR(measure(fitted, "radius").value, 16 * std::tan(angle), 0.06 * 16 * std::tan(angle));
        EXPECT_NEAR(measure(fitted, "half_angle").value, angle * degrees, 1e-6);
      }
}

TEST(Cone, OutliersDoNotMoveIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double turn : {2 * pi, pi}) {
      const PointSets sets = with_outliers(cone_points(0.4, 8, 25, turn, 600, 0.05, seed), 0.3, seed);
      const FittedShape fitted = fit(*shape("cone"), sets);
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      EXPECT_LT(error(fitted, Vec3::Zero(), Vec3::UnitZ(), 0.4, 16), 0.03) << seed << " " << turn;
      EXPECT_GT(fitted.unexplained, 3);
    }
}

TEST(Cone, UncertaintyIsCalibrated) {
  for (const double turn : {2 * pi, 2 * pi / 3}) {
    Calibration angle, tilt, apex, along;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const FittedShape fitted = fit(*shape("cone"), cone_points(0.5, 5, 20, turn, 300, 0.1, seed));
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      angle.add(number_parameter(fitted, "half_angle") - 0.5 * degrees, measure(fitted, "half_angle").sd);
      const Vec3 axis = vector_parameter(fitted, "axis"), point = vector_parameter(fitted, "apex");
      for (int k = 0; k < 2; ++k) {
        tilt.add(axis[k], std::sqrt(fitted.covariance[static_cast<std::size_t>(3 + k) * 8]));
        apex.add(point[k], std::sqrt(fitted.covariance[static_cast<std::size_t>(k) * 8]));
      }
      along.add(point.z(), std::sqrt(fitted.covariance[16]));
    }
    expect_calibrated(angle, "angle");
    expect_calibrated(tilt, "axis");
    expect_calibrated(apex, "apex across");
    expect_calibrated(along, "apex along");
  }
}

TEST(Cone, CylindersAndPlanesAreRefused) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FittedShape tube = fit(*shape("cone"), cylinder_points(8, 20, 2 * pi, 300, 0.1, seed));
    EXPECT_FALSE(tube.summary.usable()) << seed;
    EXPECT_NE(tube.summary.message.find("cylinder"), std::string::npos) << tube.summary.message;
  }
}

TEST(Cone, DoesNotDependOnPoseScaleOrOrder) {
  expect_pose_scale_and_order_do_not_matter(*shape("cone"),
                                            with_outliers(cone_points(0.4, 8, 25, 4, 900, 0.1), 0.1, 3));
}

TEST(Cone, TwoRunsOnTwoThreadsGiveTheSameBits) {
  expect_same_bits_on_another_thread(*shape("cone"), with_outliers(cone_points(0.4, 8, 25, 4, 300, 0.1), 0.1, 3));
}

TEST(Cone, DegeneratePointsAreRefusedWithAReason) {
  expect_degenerate_points_are_refused(*shape("cone"));
}

TEST(Cone, DistanceBoundsAndOutline) {
  std::vector<Vec3> samples = cone_points(0.5, 0, 60, 2 * pi, 100000).points;
  samples.push_back(Vec3::Zero());  // what lies before the apex is as far as the apex
  for (const double low : {0.0, 4.0})
    expect_sound(*shape("cone"), cone_points(0.5, low, 10, 2 * pi, 200), samples, 0.8);
}

}  // namespace
}  // namespace toposcope::test
