// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <random>

#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

// A swept wing's edge on the side x > 0: leading edge, tip, trailing edge, `steps` points along each.
std::vector<Vec3> wing(int steps, double length = 1.5) {
  const Vec3 corners[] = {{0.3, 0.0, 0}, {0.3 + length, -0.9, 0.2}, {0.3 + length, -1.3, 0.2}, {0.3, -0.8, 0}};
  std::vector<Vec3> points;
  for (int part = 0; part < 3; ++part)
    for (int i = 0; i < steps; ++i)
      points.push_back(corners[part] + (corners[part + 1] - corners[part]) * (static_cast<double>(i) / steps));
  return points;
}

std::vector<Vec3> mirrored(std::vector<Vec3> points) {
  for (Vec3& p : points) p.x() = -p.x();
  return points;
}

TEST(ReflectiveSymmetry, MirrorImagesHaveNoResidual) {
  const auto relation = test::relation("reflective-symmetry");
  for (const int steps : {10, 40, 300}) {
    const RelationResult result = relate(*relation, points_feature(wing(steps)), points_feature(mirrored(wing(steps))));
    ASSERT_TRUE(result.applicable) << result.why;
    EXPECT_NEAR(result.residual, 0, 1e-9) << steps;
    EXPECT_NEAR(result.tolerance, 0.2, 1e-12);
  }
}

TEST(ReflectiveSymmetry, CongruentButNotMirroredHasAResidual) {
  // A helix has a hand: its translated copy is no mirror image of it, the helix of the other hand is.
  std::vector<Vec3> helix, copy;
  for (int i = 0; i < 200; ++i) {
    const double turn = 4 * pi * i / 200;
    helix.push_back(Vec3(std::cos(turn) + 2, std::sin(turn), 0.2 * turn));
    copy.push_back(Vec3(std::cos(turn) - 2, std::sin(turn), 0.2 * turn));
  }
  const auto relation = test::relation("reflective-symmetry");
  const RelationResult same_hand = relate(*relation, points_feature(helix), points_feature(copy));
  EXPECT_GT(same_hand.residual, same_hand.tolerance);
  EXPECT_NEAR(relate(*relation, points_feature(helix), points_feature(mirrored(helix))).residual, 0, 1e-9);
}

// Brute force: the least rms over a fine search of planes around the true one must not be undercut nor missed by much.
TEST(ReflectiveSymmetry, UnequalPairIsNotJudgedByItsCentroids) {
  const std::vector<Vec3> whole = wing(40);
  std::vector<Vec3> partial;  // the other wing without the inner third of its trailing edge
  for (const Vec3& p : mirrored(whole))
    if (!(p.y() < -0.6 && p.x() > -0.6)) partial.push_back(p);
  ASSERT_LT(partial.size(), whole.size());
  const RelationResult result =
      relate(*test::relation("reflective-symmetry"), points_feature(whole), points_feature(partial));
  const auto rms = [&](const Vec3& normal, double offset) {
    const auto one_way = [&](const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
      double sum = 0;
      for (const Vec3& p : from) {
        const Vec3 image = p - 2 * (normal.dot(p) - offset) * normal;
        double best = 1e30;
        for (const Vec3& q : to) best = std::min(best, (q - image).squaredNorm());
        sum += best;
      }
      return sum / static_cast<double>(from.size());
    };
    return std::sqrt((one_way(whole, partial) + one_way(partial, whole)) / 2);
  };
  const double at_truth = rms(Vec3::UnitX(), 0);
  EXPECT_LT(result.residual, at_truth * 1.02);
  Vec3 between = Vec3::Zero();
  for (const Vec3& p : whole) between += p / static_cast<double>(whole.size());
  for (const Vec3& p : partial) between -= p / static_cast<double>(partial.size());
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : whole) middle += p / static_cast<double>(2 * whole.size());
  for (const Vec3& p : partial) middle += p / static_cast<double>(2 * partial.size());
  EXPECT_LT(result.residual, rms(between.normalized(), between.normalized().dot(middle)));
}

TEST(ReflectiveSymmetry, NoiseShowsInTheResidual) {
  std::mt19937_64 random(5);
  std::vector<Vec3> one = wing(40), other = mirrored(one);
  const double sd = 0.01;
  const auto uniform = [&] { return sd * std::sqrt(12.0) * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5); };
  for (Vec3& p : one) p += Vec3(uniform(), uniform(), uniform());
  for (Vec3& p : other) p += Vec3(uniform(), uniform(), uniform());
  const double residual =
      relate(*test::relation("reflective-symmetry"), points_feature(one), points_feature(other)).residual;
  EXPECT_GT(residual, sd);
  EXPECT_LT(residual, std::sqrt(6.0) * sd * 1.05);  // the distance of paired points, were they not the nearest
}

TEST(ReflectiveSymmetry, CoincidingCentroidsTryThePrincipalAxes) {
  // Two bars that cross at their middles: mirrored by the bisector, which the centroids cannot tell.
  std::vector<Vec3> first, second;
  for (int i = -30; i <= 30; ++i) {
    first.push_back(Vec3(0.05 * i, 0.02 * i, 0));
    second.push_back(Vec3(0.05 * i, -0.02 * i, 0));
  }
  const RelationResult result =
      relate(*test::relation("reflective-symmetry"), points_feature(first), points_feature(second));
  EXPECT_NEAR(result.residual, 0, 1e-9);
}

TEST(ReflectiveSymmetry, BoxesOfUnlikeSizeAreRejectedAtOnce) {
  const RelationResult result = relate(*test::relation("reflective-symmetry"), points_feature(wing(40, 3.0)),
                                       points_feature(mirrored(wing(40, 0.2))));
  EXPECT_GT(result.residual, result.tolerance);
}

TEST(ReflectiveSymmetry, PointOrderDoesNotMatter) {
  const auto relation = test::relation("reflective-symmetry");
  std::vector<Vec3> one = wing(100), other = mirrored(wing(90));
  const double before = relate(*relation, points_feature(one), points_feature(other)).residual;
  EXPECT_GT(before, 0);
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 5; ++trial) {
    std::shuffle(one.begin(), one.end(), random);
    std::shuffle(other.begin(), other.end(), random);
    EXPECT_NEAR(relate(*relation, points_feature(one), points_feature(other)).residual, before, 1e-9);
  }
}

TEST(ReflectiveSymmetry, PoseScaleAndOrderDoNotMatter) {
  std::vector<Vec3> other = mirrored(wing(90, 1.4));
  for (std::size_t i = 0; i < other.size(); ++i) other[i].z() += 0.01 * std::sin(static_cast<double>(i));
  expect_invariant(*test::relation("reflective-symmetry"), points_feature(wing(100)), points_feature(other), 1, 1e-7);
}

TEST(ReflectiveSymmetry, SaysWhatTheKernelNeeds) {
  Feature first = points_feature(wing(40)), second = points_feature(mirrored(wing(40)));
  first.shape.explained = 37;
  second.shape.explained = 52;
  const auto relation = test::relation("reflective-symmetry");
  EXPECT_EQ(relate(*relation, first, second).samples, 37);
  first.shape.explained = 0.2;
  EXPECT_EQ(relate(*relation, first, second).samples, 1);
  EXPECT_NEAR(relate(*relation, first, second).clutter_density, 4 / std::sqrt(29.0), 1e-12);
}

TEST(ReflectiveSymmetry, ShapesOfDifferentKindsDoNotApply) {
  Feature circle = circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1);
  circle.points = wing(10);
  const RelationResult result = relate(*test::relation("reflective-symmetry"), circle, points_feature(wing(10)));
  EXPECT_FALSE(result.applicable);
  EXPECT_NE(result.why.find("radius"), std::string::npos);
}

}  // namespace
