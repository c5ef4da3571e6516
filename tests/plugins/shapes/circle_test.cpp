// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <thread>

#include "shape_fixture.h"
#include "toposcope/geometry/lines.h"

namespace toposcope::test {
namespace {

/// `turn` radians of a circle in z = 0 about the origin, one point per mean edge of arc.
PointSets arc(double radius, int count, double turn = 2 * pi, double noise = 0, std::uint64_t seed = 1) {
  Random random(seed);
  PointSets sets;
  for (int i = 0; i < count; ++i) {
    const double angle = turn * (i + 0.5) / count;
    sets.points.push_back(Vec3(radius * std::cos(angle), radius * std::sin(angle), 0) + random.normal3(noise));
  }
  sets.mean_edge = radius * turn / count;
  return sets;
}

/// A piece of handle: a strip that leaves the ring of `radius` outwards at angle 0, in the ring's plane and below.
void add_handle(PointSets& sets, double radius, int count, std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < count; ++i)
    sets.points.push_back(Vec3(radius + sets.mean_edge * (1 + 9 * random.uniform()),
                               sets.mean_edge * 4 * (random.uniform() - 0.5), -sets.mean_edge * 3 * random.uniform()));
}

/// Greatest difference of a fit from the circle about `center`, in units of its radius.
double error(const FittedShape& shape, const Vec3& center, const Vec3& normal, double radius) {
  return std::max({(vector_parameter(shape, "center") - center).norm() / radius,
                   line_angle(vector_parameter(shape, "normal"), normal),
                   std::abs(number_parameter(shape, "radius") - radius) / radius});
}

TEST(Circle, RecoversExactCircles) {
  for (const char* method : {"robust", "powell"})
    for (const double turn : {2 * pi, pi, pi / 2}) {
      const auto fitter = shape("circle", {{"method", method}});
      Random random(7);
      const Eigen::Matrix3d rotation = random.rotation();
      const Vec3 shift(3, -20, 11);
      const FittedShape fitted = fit(*fitter, transformed(arc(5, 60, turn), rotation, 2, shift));
      ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
      EXPECT_LT(error(fitted, shift, rotation.col(2), 10), std::string(method) == "robust" ? 1e-9 : 1e-6)
          << method << " on an arc of " << turn;
      EXPECT_NEAR(fitted.coverage, turn / (2 * pi), 0.04);
      EXPECT_NEAR(fitted.explained, 60, 2.5);
      EXPECT_EQ(fitted.unexplained, 0);
      EXPECT_LT(fitted.rms, 1e-6);
    }
}

TEST(Circle, HandleOnTheRingDoesNotMoveIt) {
  const auto fitter = shape("circle");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PointSets ring = arc(10, 90, 2 * pi, 0.02, seed);
    const int outliers = 30 + static_cast<int>(seed % 3) * 4;  // 25 to 30 % of all
    add_handle(ring, 10, outliers, seed);
    const FittedShape fitted = fit(*fitter, ring);
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_LT((vector_parameter(fitted, "center")).norm(), 0.1 * ring.mean_edge) << seed;
    EXPECT_NEAR(number_parameter(fitted, "radius"), 10, 0.1 * ring.mean_edge) << seed;
    EXPECT_LT(10 * line_angle(vector_parameter(fitted, "normal"), Vec3::UnitZ()), 0.1 * ring.mean_edge) << seed;
    EXPECT_GT(fitted.unexplained, 10);
    // Plain least squares fails on the same points: the test has teeth.
    EXPECT_GT(std::abs(number_parameter(fit(*shape("circle", {{"method", "powell"}}), ring), "radius") - 10),
              0.1 * ring.mean_edge);
  }
}

TEST(Circle, ThickRingGivesItsMiddleLine) {
  const auto fitter = shape("circle");
  Random random(3);
  PointSets filled, lips;
  filled.mean_edge = lips.mean_edge = 0.5;
  for (int i = 0; i < 600; ++i) {
    const double angle = 2 * pi * i / 600, offset = 1.5 * (2 * random.uniform() - 1);  // a band of six edges
    filled.points.push_back((10 + offset) * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  for (int i = 0; i < 240; ++i) {
    const double angle = 2 * pi * i / 240;
    lips.points.push_back((10 + (i % 2 ? 0.75 : -0.75)) * Vec3(std::cos(angle), std::sin(angle), 0) +
                          random.normal3(0.05));
  }
  for (const PointSets& sets : {filled, lips}) {
    const FittedShape fitted = fit(*fitter, sets);
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_LT(vector_parameter(fitted, "center").norm(), 0.3 * sets.mean_edge);
    EXPECT_NEAR(number_parameter(fitted, "radius"), 10, 0.2 * sets.mean_edge);
  }
}

TEST(Circle, QuarterArcIsUnbiasedAndSaysHowUncertainItIs) {
  const auto fitter = shape("circle");
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    sum += number_parameter(fit(*fitter, arc(1, 200, pi / 2, 0.01, seed)), "radius") / 200;
  EXPECT_NEAR(sum, 1, 0.002);
  const FittedShape quarter = fit(*fitter, arc(1, 50, pi / 2, 0.01)), full = fit(*fitter, arc(1, 200, 2 * pi, 0.01));
  EXPECT_GT(measure(quarter, "radius").sd, 8 * measure(full, "radius").sd);
  EXPECT_GT(quarter.direction_sd, 4 * full.direction_sd);
  EXPECT_GT(quarter.centroid_sd, 8 * full.centroid_sd);
}

TEST(Circle, UncertaintyIsCalibrated) {
  const auto fitter = shape("circle");
  for (const double turn : {2 * pi, pi}) {
    Calibration radius, tilt, center;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const FittedShape fitted = fit(*fitter, arc(8, 100, turn, 0.05, seed));
      ASSERT_TRUE(fitted.summary.usable());
      radius.add(number_parameter(fitted, "radius") - 8, measure(fitted, "radius").sd);
      const Vec3 normal = vector_parameter(fitted, "normal"), c = vector_parameter(fitted, "center");
      for (int axis = 0; axis < 2; ++axis) {
        tilt.add(normal[axis], std::sqrt(fitted.covariance[static_cast<std::size_t>(3 + axis) * 8]));
        center.add(c[axis], std::sqrt(fitted.covariance[static_cast<std::size_t>(axis) * 8]));
      }
    }
    for (const Calibration* each : {&radius, &tilt, &center}) {
      EXPECT_GT(each->variance(), 0.6) << turn;
      EXPECT_LT(each->variance(), 1.6) << turn;
    }
  }
}

TEST(Circle, UncertaintyMeetsTheCramerRaoBound) {
  // Full turn, n points with noise s: sd(radius) = s / sqrt(n), sd(centre) = s sqrt(2 / n), sd(tilt) = s sqrt(2 / n) /
  // r.
  const double noise = 0.02, n = 100;
  const FittedShape fitted = fit(*shape("circle"), arc(3, 100, 2 * pi, noise));
  EXPECT_NEAR(measure(fitted, "radius").sd, noise / std::sqrt(n), 0.15 * noise / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(fitted.covariance[0]), noise * std::sqrt(2 / n), 0.15 * noise * std::sqrt(2 / n));
  EXPECT_NEAR(fitted.direction_sd, noise * std::sqrt(2 / n) / 3, 0.15 * noise * std::sqrt(2 / n) / 3);
}

TEST(Circle, MoreVerticesOnTheSameArcAreNotMoreSamples) {
  PointSets dense = arc(8, 800, 2 * pi, 0.05);
  dense.mean_edge *= 8;  // eight vertices per mean edge of arc
  EXPECT_NEAR(fit(*shape("circle"), dense).explained, 100, 1);
  EXPECT_GT(measure(fit(*shape("circle"), dense), "radius").sd, 0.8 * 0.05 / std::sqrt(100.0));
}

TEST(Circle, DoesNotDependOnPoseScaleOrOrder) {
  for (const char* method : {"robust", "powell"}) {
    const auto fitter = shape("circle", {{"method", method}});
    PointSets ring = arc(10, 700, 1.5 * pi, 0.03);
    add_handle(ring, 10, 100, 5);
    const FittedShape base = fit(*fitter, ring);
    ASSERT_TRUE(base.summary.usable());
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Random random(seed);
      const Eigen::Matrix3d rotation = random.rotation();
      const double scale = std::exp(3 * random.normal());
      const Vec3 shift = random.normal3(20 * scale);
      const FittedShape moved = fit(*fitter, transformed(shuffled(ring, seed), rotation, scale, shift));
      ASSERT_TRUE(moved.summary.usable());
      EXPECT_LT(error(moved, rotation * (scale * vector_parameter(base, "center")) + shift,
                      rotation * vector_parameter(base, "normal"), scale * number_parameter(base, "radius")),
                std::string(method) == "robust" ? 1e-6 : 1e-5);
      EXPECT_NEAR(moved.rms / scale, base.rms, 1e-5 * base.rms);
      EXPECT_NEAR(moved.explained, base.explained, 1e-5 * base.explained);
      EXPECT_NEAR(measure(moved, "radius").sd / scale, measure(base, "radius").sd, 1e-4 * measure(base, "radius").sd);
    }
  }
}

TEST(Circle, TwoRunsOnTwoThreadsGiveTheSameBits) {
  for (const char* method : {"robust", "powell"}) {
    const auto fitter = shape("circle", {{"method", method}});
    PointSets ring = arc(10, 90, 2 * pi, 0.1);
    add_handle(ring, 10, 20, 5);
    const FittedShape one = fit(*fitter, ring);
    FittedShape two;
    std::thread([&] { two = fit(*fitter, ring); }).join();  // another thread, with its own random numbers in NLopt
    EXPECT_EQ(parameter_values(one, "center"), parameter_values(two, "center"));
    EXPECT_EQ(one.covariance, two.covariance);
  }
}

TEST(Circle, DegeneratePointsAreRefusedWithAReason) {
  for (const char* method : {"robust", "powell"}) {
    const auto fitter = shape("circle", {{"method", method}});
    PointSets line, spot, pair;
    for (int i = 0; i < 50; ++i) line.points.push_back(Vec3(1, 2, 3) + i * Vec3(0.3, -0.1, 0.7));
    for (int i = 0; i < 50; ++i) spot.points.push_back(Vec3(1, 2, 3));
    pair.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)};
    for (const PointSets& sets : {line, spot, pair, PointSets{{Vec3(1, 1, 1), Vec3(2, 2, 1)}, 1, {}}, PointSets{}}) {
      const FittedShape fitted = fit(*fitter, sets);
      EXPECT_EQ(fitted.summary.termination, Termination::degenerate);
      EXPECT_FALSE(fitted.summary.message.empty());
    }
  }
  EXPECT_NEAR(
      number_parameter(fit(*shape("circle"), {{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0)}, 1, {}}), "radius"), 1,
      1e-9)
      << "three points determine a circle";
}

TEST(Circle, PowellAgreesWithRobustOnCleanPoints) {
  const PointSets ring = arc(10, 200, 1.6 * pi, 0.02);
  const FittedShape robust = fit(*shape("circle"), ring), powell = fit(*shape("circle", {{"method", "powell"}}), ring);
  EXPECT_LT(error(powell, vector_parameter(robust, "center"), vector_parameter(robust, "normal"),
                  number_parameter(robust, "radius")),
            1e-3);
  EXPECT_LE(powell.summary.final_cost, powell.summary.initial_cost);
}

TEST(Circle, DistanceIsExact) {
  const auto fitter = shape("circle");
  Random random(2);
  const Eigen::Matrix3d rotation = random.rotation();
  const FittedShape fitted = fit(*fitter, transformed(arc(2, 50), rotation, 1, Vec3(1, 2, 3)));
  const auto at = [&](double x, double y, double z) {
    return fitter->distance(fitted, rotation * Vec3(x, y, z) + Vec3(1, 2, 3));
  };
  EXPECT_NEAR(at(2, 0, 0), 0, 1e-9);
  EXPECT_NEAR(at(5, 0, 4), 5, 1e-9);
  EXPECT_NEAR(at(0, 0, 0), 2, 1e-9);
  EXPECT_NEAR(at(0, 0, 1.5), 2.5, 1e-9);
}

TEST(Circle, BoundsContainTheFitAndOutlineLiesOnIt) {
  const auto fitter = shape("circle");
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    const PointSets sets = arc(5, 40, 0.3 + 6 * random.uniform(), 0.3 * random.uniform(), seed);
    const FittedShape fitted = fit(*fitter, sets);
    if (!fitted.summary.usable()) continue;
    const Interval range = bounds(*fitter, "radius", sets);
    EXPECT_LE(range.low, measure(fitted, "radius").value);
    EXPECT_GE(range.high, measure(fitted, "radius").value);
    for (const Vec3& point : fitted.outline)
      EXPECT_NEAR(fitter->distance(fitted, point), 0, 1e-9 * measure(fitted, "radius").value);
  }
}

}  // namespace
}  // namespace toposcope::test
