// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

Feature circle(const Vec3& center, const Vec3& normal = Vec3::UnitZ(), double radius = 1) {
  return circle_feature(center, normal, radius);
}
Vec3 tilted(double angle) {
  return {std::sin(angle), 0, std::cos(angle)};
}

TEST(Concentric, CoaxialCirclesHaveNoResidual) {
  const auto relation = test::relation("concentric");
  for (const double sign : {1.0, -1.0}) {
    const RelationResult result =
        relate(*relation, circle(Vec3(1, 1, 0)), circle(Vec3(1, 1, 3), sign * Vec3::UnitZ(), 2));
    EXPECT_NEAR(result.residual, 0, 1e-12);
    EXPECT_NEAR(result.tolerance, 0.15, 1e-12);  // of the smaller radius
    EXPECT_GT(result.clutter_density, 0);
    EXPECT_EQ(result.dof, 2);
  }
}

TEST(Concentric, OffsetOfTheAxesIsTheResidual) {
  const auto relation = test::relation("concentric");
  EXPECT_NEAR(relate(*relation, circle(Vec3(0, 0, 0)), circle(Vec3(0.3, 0.4, 7))).residual, 0.5, 1e-12);
}

// The residual of a pure tilt is the rms displacement of the smaller circle's points: brute force over its points.
TEST(Concentric, TiltMovesTheSmallerCircle) {
  const auto relation = test::relation("concentric");
  const double tilt = 0.2, radius = 0.8;
  const RelationResult result = relate(*relation, circle(Vec3::Zero(), tilted(tilt), radius), circle(Vec3::Zero()));
  double sum = 0;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * pi / 180;
    const double height = radius * std::cos(angle) * std::sin(tilt);  // above the plane of the larger
    sum += height * height;
  }
  EXPECT_NEAR(result.residual, std::sqrt(sum / 360), 1e-9);
}

TEST(Concentric, PerpendicularCirclesAreFarFromConcentric) {
  const RelationResult result =
      relate(*test::relation("concentric"), circle(Vec3::Zero()), circle(Vec3::Zero(), Vec3::UnitX()));
  EXPECT_GT(result.residual, 4 * result.tolerance);
}

TEST(Concentric, DeviationFollowsTheFits) {
  Feature first = circle(Vec3::Zero()), second = circle(Vec3(0, 0, 4));
  first.shape.centroid_sd = 0.03;
  second.shape.centroid_sd = 0.04;
  const auto relation = test::relation("concentric");
  EXPECT_NEAR(relate(*relation, first, second).sd, 0.05, 1e-12);
  first.shape.direction_sd = 0.01;
  // The mean normal moves by half the first's error, over a lever of 4; the tilt moves circle points by r/sqrt(2).
  EXPECT_NEAR(relate(*relation, first, second).sd, std::sqrt(0.05 * 0.05 + (4 + 0.5) * 0.01 * 0.01), 1e-12);
}

// Axes through a uniform grid over the disk of radius a/2 = 2: how many come closer than the residual?
TEST(Concentric, ClutterDensityIsThatOfAxesInADisk) {
  const auto relation = test::relation("concentric");
  for (const double offset : {0.2, 0.9, 1.7}) {
    const double density = relate(*relation, circle(Vec3::Zero()), circle(Vec3(offset, 0, 0))).clutter_density;
    int inside = 0, closer = 0, farther = 0;
    const double step = 0.005, band = 0.05;
    for (double x = -2; x <= 2; x += step)
      for (double y = -2; y <= 2; y += step) {
        const double r = std::hypot(x, y);
        inside += r <= 2;
        closer += r <= offset - band;
        farther += r <= offset + band;
      }
    EXPECT_NEAR(density * offset, (farther - closer) / (2 * band * inside), 0.01);
  }
}

TEST(Concentric, PoseScaleAndOrderDoNotMatter) {
  Feature first = circle(Vec3(0.1, 0, 0), tilted(0.1), 1.2), second = circle(Vec3(0, 0.2, 2), Vec3(0.1, 0.2, -1));
  first.shape.direction_sd = 0.02;
  second.shape.centroid_sd = 0.01;
  expect_invariant(*test::relation("concentric"), first, second, 1);
}

/// A round shape of another kind: along its axis, or with a ring about it.
Feature round_shape(Feature feature, Orientation orientation, const char* measure) {
  feature.shape.orientation = orientation;
  feature.shape.measures[0].name = measure;
  return feature;
}

TEST(Concentric, WhatHasAnAxisAndARadiusIsAsACircle) {
  const auto relation = test::relation("concentric");
  Feature first = circle(Vec3(0.1, 0, 0), tilted(0.1), 1.2), second = circle(Vec3(0, 0.2, 2), Vec3(0.1, 0.2, -1));
  first.shape.direction_sd = 0.02;
  const RelationResult circles = relate(*relation, first, second);
  const Feature cylinder = round_shape(second, Orientation::line_like, "radius");
  const Feature torus = round_shape(second, Orientation::plane_like, "major_radius");
  for (const Feature& other : {cylinder, torus}) {
    const RelationResult result = relate(*relation, first, other);
    ASSERT_TRUE(result.applicable) << result.why;
    EXPECT_EQ(result.residual, circles.residual);
    EXPECT_EQ(result.tolerance, circles.tolerance);
    EXPECT_EQ(result.sd, circles.sd);
  }
  expect_invariant(*relation, cylinder, torus, 1);
  EXPECT_FALSE(relate(*relation, first, round_shape(second, Orientation::none, "radius")).applicable) << "a sphere";
}

TEST(Concentric, OnlyRoundShapesAreConcentric) {
  const auto relation = test::relation("concentric");
  const RelationResult line = relate(*relation, circle(Vec3::Zero()), segment_feature(Vec3::Zero(), Vec3::UnitZ()));
  EXPECT_FALSE(line.applicable);
  EXPECT_NE(line.why.find("radius"), std::string::npos);
}

}  // namespace
