// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "shape_fixture.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::test {
namespace {

/// Equilateral lattice of mean edge 1 on a patch of the plane z = 0, `nx` by `ny` points, centred on the origin.
PointSets patch(int nx, int ny, double noise = 0, std::uint64_t seed = 1) {
  Random random(seed);
  PointSets sets;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      sets.points.push_back(Vec3(x + 0.5 * (y % 2) - (nx - 0.5) / 2, (y - (ny - 1) / 2.0) * std::sqrt(3.0) / 2, 0) +
                            Vec3(0, 0, noise * random.normal()));
  return sets;
}

double error(const FittedShape& fitted, const Vec3& point, const Vec3& normal) {
  return std::max(std::abs((vector_parameter(fitted, "point") - point).dot(normal)),
                  line_angle(vector_parameter(fitted, "normal"), normal));
}

TEST(Plane, RecoversExactPlanes) {
  for (const char* method : {"robust", "powell"}) {
    Random random(7);
    const Eigen::Matrix3d rotation = random.rotation();
    const Vec3 shift(3, -20, 11);
    const FittedShape fitted =
        fit(*shape("plane", {{"method", method}}), transformed(patch(20, 12), rotation, 2, shift));
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_LT(error(fitted, shift, rotation.col(2)), 1e-9);
    EXPECT_EQ(fitted.unexplained, 0);
    EXPECT_NEAR(fitted.explained, std::sqrt(240.0), 1e-9);
    EXPECT_NEAR(measure(fitted, "area").value, 4.0 * 240, 1e-6);
    EXPECT_NEAR(measure(fitted, "extent").value, 2 * 19.5, 0.4);
  }
}

TEST(Plane, OutliersDoNotTiltIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PointSets sets = patch(20, 20, 0.05, seed);
    Random random(seed + 100);
    for (int i = 0; i < 120; ++i)  // a wall that rises from one side: 23 % of all points
      sets.points.push_back(Vec3(10 + random.uniform(), 17 * (random.uniform() - 0.5), 6 * random.uniform()));
    const FittedShape robust = fit(*shape("plane"), sets);
    ASSERT_TRUE(robust.summary.usable()) << robust.summary.message;
    EXPECT_LT(10 * error(robust, Vec3::Zero(), Vec3::UnitZ()), 0.1) << seed;
    EXPECT_GT(10 * error(fit(*shape("plane", {{"method", "powell"}}), sets), Vec3::Zero(), Vec3::UnitZ()), 0.5)
        << "plain least squares fails here: the test has teeth";
  }
}

TEST(Plane, UncertaintyIsCalibrated) {
  for (const char* method : {"robust", "powell"}) {
    const auto fitter = shape("plane", {{"method", method}});
    Calibration tilt, offset;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const FittedShape fitted = fit(*fitter, patch(20, 8, 0.1, seed));
      ASSERT_TRUE(fitted.summary.usable());
      const Vec3 normal = vector_parameter(fitted, "normal");
      for (std::size_t axis = 0; axis < 2; ++axis)
        tilt.add(normal[static_cast<int>(axis)], std::sqrt(fitted.covariance[(3 + axis) * 7]));
      offset.add(vector_parameter(fitted, "point").dot(Vec3::UnitZ()), std::sqrt(fitted.covariance[14]));
    }
    for (const Calibration* each : {&tilt, &offset}) {
      EXPECT_GT(each->variance(), 0.6) << method;
      EXPECT_LT(each->variance(), 1.6) << method;
    }
  }
}

TEST(Plane, UncertaintyMeetsTheCramerRaoBound) {
  const PointSets sets = patch(40, 40, 0.1);
  const FittedShape fitted = fit(*shape("plane", {{"method", "powell"}}), sets);
  const double variance = principal_axes(sets.points).variance[0], n = 1600;
  EXPECT_NEAR(fitted.direction_sd, 0.1 / std::sqrt(n * variance), 0.2 * fitted.direction_sd);
  EXPECT_NEAR(std::sqrt(fitted.covariance[14]), 0.1 / std::sqrt(n), 0.2 * 0.1 / std::sqrt(n));
}

TEST(Plane, NarrowStripIsUncertainAcross) {
  EXPECT_GT(fit(*shape("plane"), patch(100, 2, 0.1)).direction_sd,
            5 * fit(*shape("plane"), patch(20, 10, 0.1)).direction_sd);
}

TEST(Plane, DoesNotDependOnPoseScaleOrOrder) {
  const auto fitter = shape("plane");
  PointSets sets = patch(20, 10, 0.1);
  for (int i = 0; i < 40; ++i) sets.points.push_back(Vec3(10, 0.1 * i, 0.15 * i));
  const FittedShape base = fit(*fitter, sets);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    const Eigen::Matrix3d rotation = random.rotation();
    const double scale = std::exp(3 * random.normal());
    const Vec3 shift = random.normal3(20 * scale);
    const FittedShape moved = fit(*fitter, transformed(shuffled(sets, seed), rotation, scale, shift));
    ASSERT_TRUE(moved.summary.usable());
    EXPECT_LT(line_angle(moved.direction, rotation * base.direction), 1e-6);
    EXPECT_LT((moved.centroid - rotation * (scale * base.centroid) - shift).norm(), 1e-6 * scale);
    EXPECT_NEAR(moved.rms / scale, base.rms, 1e-6 * base.rms);
    EXPECT_NEAR(moved.explained, base.explained, 1e-6);
    EXPECT_NEAR(moved.direction_sd, base.direction_sd, 1e-6 * base.direction_sd);
  }
}

TEST(Plane, PowellAgreesWithRobustOnCleanPoints) {
  const PointSets sets = patch(20, 20, 0.02);
  const FittedShape robust = fit(*shape("plane"), sets), powell = fit(*shape("plane", {{"method", "powell"}}), sets);
  EXPECT_LT(error(powell, robust.centroid, robust.direction), 1e-3);
  EXPECT_EQ(powell.summary.termination, Termination::closed_form);
}

TEST(Plane, DegeneratePointsAreRefusedWithAReason) {
  PointSets line, spot;
  for (int i = 0; i < 50; ++i) line.points.push_back(Vec3(1, 2, 3) + i * Vec3(0.3, -0.1, 0.7));
  for (int i = 0; i < 50; ++i) spot.points.push_back(Vec3(1, 2, 3));
  for (const PointSets& sets : {line, spot, PointSets{{Vec3(1, 1, 1), Vec3(2, 2, 1)}, 1, {}}, PointSets{}}) {
    const FittedShape fitted = fit(*shape("plane"), sets);
    EXPECT_EQ(fitted.summary.termination, Termination::degenerate);
    EXPECT_FALSE(fitted.summary.message.empty());
  }
}

TEST(Plane, DistanceBoundsAndOutline) {
  const auto fitter = shape("plane");
  Random random(2);
  const Eigen::Matrix3d rotation = random.rotation();
  const PointSets sets = transformed(patch(20, 10), rotation, 1, Vec3(1, 2, 3));
  const FittedShape fitted = fit(*fitter, sets);
  EXPECT_NEAR(fitter->distance(fitted, rotation * Vec3(50, -3, -4) + Vec3(1, 2, 3)), 4, 1e-9);
  EXPECT_GE(bounds(*fitter, "extent", sets).high, measure(fitted, "extent").value);
  EXPECT_LE(bounds(*fitter, "extent", sets).low, measure(fitted, "extent").value);
  ASSERT_GT(fitted.outline.size(), 40U);
  EXPECT_LE(fitted.outline.size(), 512U);
  for (const Vec3& point : fitted.outline) EXPECT_NEAR(fitter->distance(fitted, point), 0, 1e-9);
  for (std::size_t i = 0; i < fitted.outline.size(); ++i)
    EXPECT_LE((fitted.outline[i] - fitted.outline[(i + 1) % fitted.outline.size()]).norm(), 1 + 1e-9);
}

}  // namespace
}  // namespace toposcope::test
