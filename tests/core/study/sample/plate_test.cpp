// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/errors.h"
#include "mesh/repair.h"
#include "sample/drilled_plate.h"
#include "sample/isosurface.h"
#include "sample/plane_triangulation.h"
#include "sample_fixture.h"

namespace toposcope {
namespace {

using test::make;

/// Area of a regular polygon with its corners on a circle.
double polygon(double radius, double corners) {
  return corners / 2 * radius * radius * std::sin(2 * pi / corners);
}

double area(std::span<const Vec2> points, const std::vector<Triangle>& triangles) {
  double twice = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec2 u = points[b] - points[a], v = points[c] - points[a];
    EXPECT_GT(u.x() * v.y() - u.y() * v.x(), 0) << "turns left";
    twice += u.x() * v.y() - u.y() * v.x();
  }
  return twice / 2;
}

TEST(Triangulation, CoversTheRegionAndNothingElse) {
  // A square of side 10 with a grid of square holes.
  for (const int holes : {0, 1, 2, 3}) {
    std::vector<Vec2> points = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    std::vector<std::vector<Index>> loops;
    for (int i = 0; i < holes; ++i)
      for (int j = 0; j < holes; ++j) {
        const Vec2 corner(1 + 3.0 * i + 0.1 * j, 1 + 3.0 * j + 0.2 * i);
        const auto first = static_cast<Index>(points.size());
        for (const Vec2& each : {Vec2(0, 0), Vec2(0, 1), Vec2(1, 1), Vec2(1, 0)}) points.push_back(corner + each);
        loops.push_back({first, first + 1, first + 2, first + 3});
      }
    const std::vector<Triangle> triangles = triangulate(points, {0, 1, 2, 3}, loops);
    EXPECT_EQ(triangles.size(), points.size() + 2 * loops.size() - 2);
    EXPECT_NEAR(area(points, triangles), 100 - holes * holes, 1e-9) << holes;
  }
}

TEST(Triangulation, OfAConcaveLoop) {
  const std::vector<Vec2> comb = {{0, 0}, {9, 0}, {9, 5}, {8, 1}, {6, 5}, {5, 1}, {3, 5}, {2, 1}, {0, 5}};
  std::vector<Index> loop(comb.size());
  std::iota(loop.begin(), loop.end(), 0);
  double twice = 0;
  for (std::size_t i = 0; i < comb.size(); ++i) {
    const Vec2 &a = comb[i], &b = comb[(i + 1) % comb.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  EXPECT_NEAR(area(comb, triangulate(comb, loop, {})), twice / 2, 1e-12);
}

/// Volume of what a cut takes away, as its tessellation has it.
double removed(const DrilledPlate& plate, const PlateCut& cut, int segments) {
  const double depth = cut.through() ? plate.mouth_height(cut) : cut.depth;
  if (cut.kind == PlateCut::Kind::hexagon) return depth * polygon(cut.radius, 6);
  const int half = segments / 2;
  if (cut.kind == PlateCut::Kind::slot) return depth * (2 * cut.radius * cut.length + polygon(cut.radius, 2 * half));
  const double cone = std::max(0.0, cut.countersink - cut.radius);
  const double a = polygon(cut.radius, segments), b = polygon(cut.countersink, segments);
  return (depth - cone) * a + (cone > 0 ? cone * (a + b + std::sqrt(a * b)) / 3 : 0);
}

TEST(DrilledPlate, IsClosedAndHasTheVolumeOfItsParts) {
  DrilledPlate plate{"plate", 60, 40, 5, 6, {}, {}, 1};
  PlateCut through{.center = {10, 5}, .radius = 3, .turn = 0.2};
  PlateCut blind{.center = {-10, 5}, .radius = 2, .depth = 4, .turn = 0.5};
  PlateCut sunk{.center = {20, -10}, .radius = 2, .countersink = 4, .turn = 0.1};
  PlateCut slot{.kind = PlateCut::Kind::slot, .center = {-18, -8}, .radius = 2, .length = 5, .turn = 0.4};
  PlateCut hexagon{.kind = PlateCut::Kind::hexagon, .center = {0, -10}, .radius = 3, .turn = 0.3};
  PlateCut bore{.center = {-20, 9}, .radius = 2, .turn = 0.7};
  plate.cuts = {through, blind, sunk, slot, hexagon, bore};
  plate.bosses = {{{-20, 9}, 4, 3, 0.2}, {{10, 14}, 3, 2, 0.1}};
  EXPECT_EQ(plate.mouth_height(bore), 9) << "through the boss around it";
  for (const int segments : {12, 13, 48, 200}) {
    const TessellatedSolid made = tessellate(plate, segments);
    EXPECT_TRUE(is_closed_manifold(made.mesh)) << segments;
    EXPECT_EQ(made.face_part.size(), made.mesh.triangles.size());
    const int quarter = segments / 4;
    double volume = plate.thickness * (60 * 40 - 4 * 25 + polygon(5, 4.0 * quarter));
    for (const PlateBoss& boss : plate.bosses) volume += boss.height * polygon(boss.radius, segments);
    for (const PlateCut& cut : plate.cuts) volume -= removed(plate, cut, segments);
    EXPECT_NEAR(test::volume(made.mesh), volume, 1e-8 * volume) << segments;
  }
}

TEST(DrilledPlate, CornersLieOnTheExactHoles) {
  const Sample sample = make({.kind = "plate"});
  for (const TruthFeature& feature : sample.truth.features) {
    if (feature.shape != "cylinder" || feature.name.starts_with("boss")) continue;
    const Vec3 mouth = test::vec(test::value(feature, "point"));
    const double radius = test::value(feature, "radius")[0], depth = test::value(feature, "depth")[0];
    for (const Vec3& point : feature.points) {
      EXPECT_NEAR((point - mouth).head<2>().norm(), radius, 1e-9) << feature.name;
      EXPECT_LE(mouth.z() - point.z(), depth + 1e-9);
    }
    std::size_t on = 0;
    for (const Vec3& p : sample.mesh.positions) on += std::abs((p - mouth).head<2>().norm() - radius) < 1e-9;
    EXPECT_EQ(on, 96U) << feature.name << ": a ring of 48 at either end";
  }
}

class RandomPlates : public testing::TestWithParam<const char*> {};

TEST_P(RandomPlates, AreClosedAndTheirHolesLieApart) {
  std::map<int, int> counts;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Sample sample = make({.kind = GetParam(), .seed = seed, .random = true});
    const auto parameter = [&](const std::string& name) {
      return std::find_if(sample.parameters.begin(), sample.parameters.end(),
                          [&](const auto& p) { return p.first == name; })
          ->second;
    };
    TriangleSoup mesh = sample.mesh;
    if (parameter("unwelded") != 0) {
      EXPECT_EQ(mesh.positions.size(), 3 * mesh.triangles.size());
      repair(mesh, "test");
    }
    EXPECT_TRUE(is_closed_manifold(mesh)) << seed;
    int holes = 0;
    for (const TruthFeature& a : sample.truth.features) {
      if (!a.name.starts_with("hole[")) continue;
      ++holes;
      EXPECT_EQ(a.name, "hole[" + std::to_string(holes) + "]");
      for (const TruthFeature& b : sample.truth.features) {
        if (!(&a < &b) || !b.name.starts_with("hole[")) continue;
        const Vec3 way = test::vec(test::value(a, "point")) - test::vec(test::value(b, "point"));
        EXPECT_GT(way.head<2>().norm(), test::value(a, "radius")[0] + test::value(b, "radius")[0]);
      }
    }
    const double bolts = std::string(GetParam()) == "plate" ? parameter("bolt_holes") : 0;
    EXPECT_EQ(holes, static_cast<int>(parameter("holes") + bolts));
    EXPECT_GE(holes, 3);
    EXPECT_LE(holes, 60);
    ++counts[holes / 10];
  }
  EXPECT_GE(counts.size(), 3U) << "few and many";
}
INSTANTIATE_TEST_SUITE_P(Kinds, RandomPlates, testing::Values("plate", "flange"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(DrilledPlate, BoltCirclesAreRegular) {
  const Sample sample = make({.kind = "flange", .parameters = {{"holes", 5}, {"bolt_circle_radius", 70}}});
  std::vector<double> angles;
  for (const TruthFeature& feature : sample.truth.features) {
    if (!feature.name.starts_with("hole[")) continue;
    const Vec3 middle = test::vec(test::value(feature, "point"));
    EXPECT_NEAR(middle.head<2>().norm(), 70, 1e-9);
    EXPECT_EQ(test::value(feature, "bolt_circle_radius")[0], 70);
    angles.push_back(std::atan2(middle.y(), middle.x()));
  }
  std::sort(angles.begin(), angles.end());
  ASSERT_EQ(angles.size(), 5U);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(angles[i] - angles[i - 1], 2 * pi / 5, 1e-9);
}

TEST(DrilledPlate, ContradictionsAreRefused) {
  const auto refused = [](const std::string& kind, std::map<std::string, double> parameters) {
    try {
      make({.kind = kind, .parameters = std::move(parameters)});
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(refused("plate", {{"bolt_holes", 2}}).find("bolt_holes is 2: a circle takes three"), std::string::npos);
  EXPECT_NE(refused("plate", {{"holes", 60}}).find("holes is 60: with those of the bolt circle"), std::string::npos);
  EXPECT_NE(refused("plate", {{"holes", 50}, {"hole_radius", 12}, {"slots", 0}, {"hexagons", 0}})
                .find("holes is 50: there is no room"),
            std::string::npos);
  EXPECT_NE(refused("plate", {{"bolt_holes", 24}, {"bolt_circle_radius", 10}}).find("bolt_circle_radius is 10"),
            std::string::npos);
  EXPECT_NE(refused("flange", {{"bolt_circle_radius", 50}}).find("between the middle and the edge"), std::string::npos);
  EXPECT_NE(refused("flange", {{"hub_radius", 30}}).find("hub_radius is 30"), std::string::npos);
}

}  // namespace
}  // namespace toposcope
