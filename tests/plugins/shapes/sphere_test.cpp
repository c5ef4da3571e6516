// SPDX-License-Identifier: BSD-3-Clause
#include "surface_fixture.h"

namespace toposcope::test {
namespace {

double error(const FittedShape& shape, const Vec3& center, double radius) {
  return std::max((vector_parameter(shape, "center") - center).norm(),
                  std::abs(number_parameter(shape, "radius") - radius)) /
         radius;
}

TEST(Sphere, RecoversExactSpheres) {
  for (const double cap : {pi, pi / 2, 0.6}) {
    Random random(7);
    const Eigen::Matrix3d rotation = random.rotation();
    const Vec3 shift(3, -20, 11);
    const FittedShape fitted = fit(*shape("sphere"), transformed(sphere_points(5, cap, 300), rotation, 2, shift));
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_LT(error(fitted, shift, 10), 1e-9) << cap;
    EXPECT_EQ(fitted.orientation, Orientation::none);
    EXPECT_EQ(fitted.unexplained, 0);
    EXPECT_NEAR(fitted.coverage, (1 - std::cos(cap)) / 2, 1e-9);
    EXPECT_NEAR(measure(fitted, "area").value, 2 * pi * 100 * (1 - std::cos(cap)), 1e-6);
    EXPECT_NEAR(fitted.explained, std::sqrt(300.0), 1e-9);
  }
  const FittedShape four =
      fit(*shape("sphere"), {{Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, 1, {}});
  ASSERT_TRUE(four.summary.usable()) << four.summary.message;
  EXPECT_LT(error(four, Vec3::Zero(), 1), 1e-9) << "four points determine a sphere";
}

TEST(Sphere, OutliersDoNotMoveIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double cap : {pi, 1.2}) {
      const PointSets sets = with_outliers(sphere_points(10, cap, 400, 0.05, seed), 0.3, seed);
      const FittedShape fitted = fit(*shape("sphere"), sets);
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      EXPECT_LT(10 * error(fitted, Vec3::Zero(), 10), cap > 3 ? 0.05 : 0.2) << seed;
      EXPECT_GT(fitted.unexplained, 3);
    }
}

TEST(Sphere, UncertaintyIsCalibrated) {
  for (const double cap : {pi, 1.0}) {
    Calibration radius, across, along;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const FittedShape fitted = fit(*shape("sphere"), sphere_points(8, cap, 250, 0.1, seed));
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      radius.add(number_parameter(fitted, "radius") - 8, measure(fitted, "radius").sd);
      const Vec3 c = vector_parameter(fitted, "center");
      across.add(c.x(), std::sqrt(fitted.covariance[0]));
      along.add(c.z(), std::sqrt(fitted.covariance[10]));
    }
    expect_calibrated(radius, "radius");
    expect_calibrated(across, "centre across");
    expect_calibrated(along, "centre along");
  }
}

TEST(Sphere, UncertaintyMeetsTheCramerRaoBound) {
  // A whole sphere, n points with noise s: sd(radius) = s / sqrt(n), sd(centre) = s sqrt(3 / n) per component.
  const double noise = 0.02, n = 2000;
  const FittedShape fitted = fit(*shape("sphere"), sphere_points(3, pi, 2000, noise));
  EXPECT_NEAR(measure(fitted, "radius").sd, noise / std::sqrt(n), 0.1 * noise / std::sqrt(n));
  EXPECT_NEAR(fitted.centroid_sd, noise * std::sqrt(3 / n), 0.1 * noise * std::sqrt(3 / n));
}

TEST(Sphere, SmallCapsAreUncertain) {
  EXPECT_GT(measure(fit(*shape("sphere"), sphere_points(8, 0.7, 200, 0.02)), "radius").sd,
            10 * measure(fit(*shape("sphere"), sphere_points(8, pi, 200, 0.02)), "radius").sd);
}

TEST(Sphere, DoesNotDependOnPoseScaleOrOrder) {
  expect_pose_scale_and_order_do_not_matter(*shape("sphere"), with_outliers(sphere_points(10, 1, 900, 0.1), 0.1, 3));
}

TEST(Sphere, TwoRunsOnTwoThreadsGiveTheSameBits) {
  expect_same_bits_on_another_thread(*shape("sphere"), with_outliers(sphere_points(10, 1, 300, 0.1), 0.1, 3));
}

TEST(Sphere, DegeneratePointsAreRefusedWithAReason) {
  expect_degenerate_points_are_refused(*shape("sphere"));
}

TEST(Sphere, DistanceBoundsAndOutline) {
  for (const double cap : {pi, 1.0, 0.6})
    expect_sound(*shape("sphere"), sphere_points(4, cap, 150), sphere_points(4, pi, 20000).points, 0.3);
}

}  // namespace
}  // namespace toposcope::test
