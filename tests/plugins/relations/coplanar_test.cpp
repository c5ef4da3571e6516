// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"
#include "toposcope/geometry/lines.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

/// A circle of radius 1 with its outline.
Feature ring(const Vec3& center, const Vec3& normal = Vec3::UnitZ(), double radius = 1) {
  Feature feature = circle_feature(center, normal, radius);
  const Vec3 u = any_perpendicular(feature.shape.direction), v = feature.shape.direction.cross(u);
  for (int i = 0; i < 64; ++i)
    feature.shape.outline.push_back(center + radius * (std::cos(i * pi / 32) * u + std::sin(i * pi / 32) * v));
  return feature;
}
Vec3 tilted(double angle) {
  return {std::sin(angle), 0, std::cos(angle)};
}
RelationResult coplanar(const Feature& first, const Feature& second, const Motion& motion = {}) {
  return relate(*test::relation("coplanar"), first, second, motion);
}

TEST(Coplanar, WhatLiesInOnePlaneHasNoResidual) {
  for (const double sign : {1.0, -1.0})
    EXPECT_NEAR(coplanar(ring({0, 0, 1}), ring({3, 1, 1}, sign * Vec3::UnitZ(), 2)).residual, 0, 1e-12);
  EXPECT_NEAR(coplanar(ring({0, 0, 1}), segment_feature({3, 1, 1}, {4, 4, 1})).residual, 0, 1e-12);
  EXPECT_NEAR(coplanar(segment_feature({3, 1, 1}, {4, 4, 1}), ring({0, 0, 1})).residual, 0, 1e-12);
}

TEST(Coplanar, ParallelPlanesAreTheirDistanceApart) {
  EXPECT_NEAR(coplanar(ring({0, 0, 0}), ring({3, 1, 0.4})).residual, 0.4, 1e-12);
  EXPECT_NEAR(coplanar(ring({0, 0, 0}), segment_feature({3, 1, 0.4}, {3, 2, 0.4})).residual, 0.4, 1e-12);
}

/// The mean square distance of two planes on the circle about the middle, by brute force.
TEST(Coplanar, ResidualIsTheDistanceOfThePlanesAsFarAsTheyReach) {
  const Vec3 normal = tilted(0.03), d(2, 0.5, 0.1), middle = d / 2;
  double sum = 0, reach = 0;
  for (const Feature& feature : {ring(Vec3::Zero(), normal), ring(d)})
    for (const Vec3& p : feature.shape.outline) reach = std::max(reach, (p - middle).norm());
  for (int i = 0; i < 360; ++i) {
    const double x = middle.x() + reach * std::cos(i * pi / 180);
    sum += std::pow(-normal.x() * x / normal.z() - d.z(), 2);
  }
  EXPECT_NEAR(coplanar(ring(Vec3::Zero(), normal), ring(d)).residual, std::sqrt(sum / 360), 1e-3);
}

TEST(Coplanar, TheSameAngleCountsAlikeNearAndFar) {
  for (const double apart : {0.0, 2.0, 50.0}) {
    const RelationResult result = coplanar(ring({0, 0, 0}, tilted(0.1)), ring({0, apart, 0}));
    EXPECT_NEAR(result.residual / result.tolerance, std::sin(0.1) / std::sqrt(2) / 0.1, 1e-9) << apart;
  }
}

TEST(Coplanar, SaysWhatTheKernelNeeds) {
  Feature first = ring({0, 0, 0}), second = ring({4, 0, 0});
  first.shape.centroid_sd = 0.3, second.shape.centroid_sd = 0.4;
  RelationResult result = coplanar(first, second);
  EXPECT_NEAR(result.tolerance, 0.1 * 3, 1e-9);
  EXPECT_NEAR(result.sd, 0.5, 1e-12);
  EXPECT_EQ(result.dof, 3);
  EXPECT_NEAR(result.clutter_density, 4.0 / (3 * 9), 1e-9);
  second.shape.direction_sd = 0.1;
  EXPECT_NEAR(coplanar(first, second).sd, std::sqrt(0.25 + (4 + 4.5) * 0.01), 1e-9);
  result = coplanar(first, segment_feature({4, -1, 0}, {4, 1, 0}));
  EXPECT_EQ(result.dof, 2);
  EXPECT_NEAR(result.clutter_density, std::sqrt(2) * pi / (3 * 3), 1e-9);
}

/// Of unrelated planes, turned anyhow and offset by up to half of the mean side, how many come closer than r?
TEST(Coplanar, ClutterDensityIsThatOfRandomPlanes) {
  const Feature fixed = ring({0, 0, 0});
  for (const bool line : {false, true}) {
    constexpr std::size_t count = 40000;
    const double r = line ? 0.1 : 0.2;
    double closer = 0, integral = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 direction = sphere_direction(i, count);
      const double height = 3 * (std::fmod(std::sqrt(2.0) * static_cast<double>(i), 1) - 0.5);
      Feature other = line ? segment_feature(Vec3(0, 0, height) - direction, Vec3(0, 0, height) + direction)
                           : ring({0, 0, height}, direction);
      const RelationResult result = coplanar(fixed, other);
      closer += result.residual < r;
      if (i == 0) {
        const RelationResult near = coplanar(fixed, line ? segment_feature({-1, 0, 0}, {1, 0, 0}) : fixed);
        integral = near.clutter_density * std::pow(r, near.dof) / near.dof;
      }
    }
    EXPECT_NEAR(closer / count, integral, 0.12 * integral) << (line ? "line" : "plane");
  }
}

TEST(Coplanar, PoseScaleAndOrderDoNotMatter) {
  Feature first = ring({0.1, 0, 0}, tilted(0.1), 1.2), second = ring({0, 2, 0.2}, {0.1, 0.2, -1});
  first.shape.direction_sd = 0.02, second.shape.centroid_sd = 0.01;
  for (const Feature& other : {second, segment_feature({1, 1, 0.1}, {2, 2, 0.4})}) {
    const RelationResult here = coplanar(first, other);
    EXPECT_NEAR(coplanar(other, first).residual, here.residual, 1e-12);
    EXPECT_NEAR(coplanar(other, first).sd, here.sd, 1e-12);
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const Motion motion = some_motion(seed);
      const RelationResult there = coplanar(first, other, motion);
      EXPECT_NEAR(there.residual / motion.scale, here.residual, 1e-9);
      EXPECT_NEAR(there.tolerance / motion.scale, here.tolerance, 1e-9);
      EXPECT_NEAR(there.clutter_density * std::pow(motion.scale, here.dof), here.clutter_density, 1e-9);
    }
  }
}

TEST(Coplanar, DoesNotApplyWithoutAPlane) {
  const Feature line = segment_feature({0, 0, 0}, {1, 0, 0});
  EXPECT_FALSE(coplanar(line, line).applicable);
  Feature blob = ring({0, 0, 0});
  blob.shape.orientation = Orientation::none;
  EXPECT_FALSE(coplanar(ring({0, 0, 0}), blob).applicable);
  EXPECT_FALSE(
      coplanar(circle_feature({1, 1, 1}, Vec3::UnitZ(), 1), circle_feature({1, 1, 1}, Vec3::UnitZ(), 1)).applicable)
      << "without extent";
}

}  // namespace
