// SPDX-License-Identifier: BSD-3-Clause
#include "sample/implicit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace toposcope {
namespace {

std::vector<Vec3> random_points(int count, double reach) {
  std::mt19937_64 engine(7);
  std::vector<Vec3> points;
  const auto draw = [&] { return reach * (2 * static_cast<double>(engine() >> 11) * 0x1p-53 - 1); };
  for (int i = 0; i < count; ++i) {
    const double x = draw(), y = draw(), z = draw();
    points.emplace_back(x, y, z);
  }
  return points;
}

Implicit half_space(const Vec3& normal) {
  return [n = normal.normalized().eval()](const Vec3& p) -> Distance { return {n.dot(p), n}; };
}

void expect_gradient_is_derivative(const Implicit& f, double reach) {
  constexpr double step = 1e-6;
  int compared = 0;
  for (const Vec3& p : random_points(400, reach)) {
    Vec3 difference, back;
    for (int i = 0; i < 3; ++i) {
      difference[i] = (f(p + step * Vec3::Unit(i)).value - f(p - step * Vec3::Unit(i)).value) / (2 * step);
      back[i] = (f(p + 3 * step * Vec3::Unit(i)).value - f(p - 3 * step * Vec3::Unit(i)).value) / (6 * step);
    }
    if ((difference - back).norm() > 1e-6) continue;  // on a ridge, where there is no derivative
    EXPECT_LT((difference - f(p).gradient).norm(), 1e-5) << p.transpose();
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

/// An L of two right angles: one corner convex, one concave, seen with the material on the left.
const std::vector<Corner> step_profile = {{0, 0}, {4, 0, 0.7}, {4, 2, 0.5}, {2, 2, 0.6}, {2, 5, 1.1}, {0, 5}};

TEST(PlanePath, DistanceIsThatToItsDenselySampledCurve) {
  const PlanePath path(step_profile);
  // Sample the curve by walking from each arc's end to the next arc's beginning, and over the arcs by angle.
  std::vector<Vec2> curve;
  const auto walk = [&](const Vec2& from, const Vec2& to) {
    for (int i = 0; i <= 2000; ++i) curve.push_back(from + i / 2000.0 * (to - from));
  };
  walk({0, 0}, {3.3, 0});
  walk({4, 0.7}, {4, 1.5});
  walk({3.5, 2}, {2.6, 2});
  walk({2, 2.6}, {2, 3.9});
  walk({0.9, 5}, {0, 5});
  const auto arc = [&](double x, double y, double radius, double from, double to) {
    for (int i = 0; i <= 2000; ++i) {
      const double angle = from + i / 2000.0 * (to - from);
      curve.push_back(Vec2(x + radius * std::cos(angle), y + radius * std::sin(angle)));
    }
  };
  arc(3.3, 0.7, 0.7, -pi / 2, 0);
  arc(3.5, 1.5, 0.5, 0, pi / 2);
  arc(2.6, 2.6, 0.6, pi, 1.5 * pi);
  arc(0.9, 3.9, 1.1, 0, pi / 2);
  for (const Vec3& p : random_points(300, 7)) {
    const Vec2 query = p.head<2>();
    double least = 1e300;
    for (const Vec2& q : curve) least = std::min(least, (q - query).norm());
    EXPECT_NEAR((path.closest(query).point - query).norm(), least, 2e-3);
  }
}

TEST(PlanePath, CrestOfARightAngleIsThe45DegreePoint) {
  const PlanePath path(step_profile);
  const double inset = 0.7 * (1 - std::sqrt(0.5));
  EXPECT_LT((path.crest(1) - Vec2(4 - inset, inset)).norm(), 1e-14);
  EXPECT_LT((path.arc_begin(1) - Vec2(3.3, 0)).norm(), 1e-14);
  EXPECT_LT((path.arc_end(1) - Vec2(4, 0.7)).norm(), 1e-14);
}

TEST(PlanePath, RefusesArcsThatOverlap) {
  EXPECT_THROW(PlanePath({{0, 0}, {1, 0, 0.6}, {1, 1, 0.6}, {0, 1}}), std::logic_error);
}

TEST(Revolve, HalfCircleIsASphere) {
  const Vec3 center(1, -2, 3);
  const Implicit sphere = revolve(PlanePath({{0, -2}, {2, -2, 2}, {2, 2, 2}, {0, 2}}), center, Vec3(1, 1, 1));
  for (const Vec3& p : random_points(200, 5)) {
    EXPECT_NEAR(sphere(p).value, (p - center).norm() - 2, 1e-12);
    EXPECT_LT((sphere(p).gradient - (p - center).normalized()).norm(), 1e-9);
  }
}

TEST(Revolve, SharpCylinderHasTheKnownDistance) {
  const Implicit cylinder = revolve(PlanePath({{0, 0}, {1, 0}, {1, 3}, {0, 3}}), Vec3::Zero(), Vec3::UnitZ());
  for (const Vec3& p : random_points(500, 5)) {
    const double radial = p.head<2>().norm() - 1, axial = std::abs(p.z() - 1.5) - 1.5;
    const double outside = std::hypot(std::max(radial, 0.0), std::max(axial, 0.0));
    EXPECT_NEAR(cylinder(p).value, outside > 0 ? outside : std::max(radial, axial), 1e-12);
  }
}

TEST(Sweep, StraightPathIsACapsule) {
  const Implicit capsule = sweep(PlanePath({{0, 0}, {4, 0}}), Vec3(1, 0, 0), Vec3::UnitY(), Vec3::UnitZ(), 0.5);
  for (const Vec3& p : random_points(200, 5)) {
    const Vec3 foot(1, std::clamp(p.y(), 0.0, 4.0), 0);
    EXPECT_NEAR(capsule(p).value, (p - foot).norm() - 0.5, 1e-12);
  }
}

TEST(Implicit, GradientsAreDerivatives) {
  const Implicit solid = revolve(PlanePath(step_profile), Vec3(0.1, 0.2, 0.3), Vec3(1, 2, 3));
  const Implicit tube = sweep(PlanePath({{-3, 0}, {2, 0, 1}, {2, 3}}), Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ(), 0.4);
  const Implicit brick = box(Vec3(1, 0, 0), Vec3(1, 2, 3), 0.3);
  for (const Implicit& f : {solid, tube, brick}) expect_gradient_is_derivative(f, 6);
  const Implicit x = half_space(Vec3(1, 0, 0)), y = half_space(Vec3(0.5, 1, 0));
  expect_gradient_is_derivative(unite(x, y, 1), 2);
  expect_gradient_is_derivative(intersect(x, y, 1), 2);
  expect_gradient_is_derivative(subtract(x, y, 1), 2);
}

TEST(Unite, FilletIsTheExactCircleAtAnyAngle) {
  for (const double angle : {0.6, pi / 2, 2.2}) {
    constexpr double radius = 0.8;
    const Vec3 n1(1, 0, 0), n2(std::cos(angle), std::sin(angle), 0);
    const Implicit corner = unite(half_space(n1), half_space(n2), radius);
    // The ball's centre has distance `radius` from both planes.
    const Vec3 center = radius / (1 + n1.dot(n2)) * (n1 + n2);
    ASSERT_NEAR(center.dot(n1), radius, 1e-12);
    for (int i = 0; i <= 10; ++i) {
      const double turn = angle * i / 10;
      const Vec3 spoke(std::cos(turn), std::sin(turn), 0);
      const Distance d = corner(center - radius * spoke);
      EXPECT_NEAR(d.value, 0, 1e-12);
      EXPECT_LT((d.gradient - spoke).norm(), 1e-6);
    }
    EXPECT_NEAR(corner(Vec3(0, 0, 5)).value, radius - center.norm(), 1e-12) << "inside the old corner";
  }
}

TEST(Unite, WithoutFilletIsTheMinimum) {
  const Implicit a = box(Vec3::Zero(), Vec3::Ones(), 0), b = box(Vec3(1, 1, 1), Vec3::Ones(), 0.2);
  for (const Vec3& p : random_points(200, 3)) {
    EXPECT_EQ(unite(a, b)(p).value, std::min(a(p).value, b(p).value));
    EXPECT_EQ(subtract(a, b)(p).value, std::max(a(p).value, -b(p).value));
  }
}

TEST(Project, EndsOnTheSurface) {
  const Implicit solid = revolve(PlanePath(step_profile), Vec3::Zero(), Vec3::UnitZ());
  for (const Vec3& p : random_points(100, 4)) EXPECT_NEAR(solid(project(solid, p, 1)).value, 0, 1e-9);
  const Implicit a = half_space(Vec3(1, 0, 0)), b = box(Vec3::Zero(), Vec3::Ones(), 0.5);
  const Vec3 q = project_to_curve(a, b, Vec3(0.3, 0.8, 0.9));
  EXPECT_NEAR(a(q).value, 0, 1e-12);
  EXPECT_NEAR(b(q).value, 0, 1e-12);
}

}  // namespace
}  // namespace toposcope
