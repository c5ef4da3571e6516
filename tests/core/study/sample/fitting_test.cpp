// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "base/errors.h"
#include "sample/solid.h"

namespace toposcope {
namespace {

const SampleKind& kind_of(const std::vector<SampleKind>& kinds, const std::string& name) {
  for (const SampleKind& kind : kinds)
    if (kind.name == name) return kind;
  throw std::out_of_range(name);
}

Solid make(const std::string& kind, const std::map<std::string, double>& parameters = {}) {
  return make_solid(kind, check_parameters(kind_of(sample_kinds(), kind), parameters));
}

struct Rim {
  bool there = false;
  Vec3 center = Vec3::Zero(), normal = Vec3::Zero();
};

std::map<std::string, Rim> rims(const Solid& solid) {
  std::map<std::string, Rim> found;
  for (const TruthFeature& f : solid.features) {
    Rim rim;
    rim.there = !f.points.empty();
    for (const auto& [name, v] : f.parameters) {
      if (name == "center") rim.center = Vec3(v[0], v[1], v[2]);
      if (name == "normal") rim.normal = Vec3(v[0], v[1], v[2]);
    }
    found[f.name] = rim;
  }
  return found;
}

bool concentric(const Rim& a, const Rim& b) {
  return std::abs(a.normal.dot(b.normal) + 1) < 1e-12 && a.normal.cross(b.center - a.center).norm() < 1e-9;
}

bool perpendicular(const Rim& a, const Rim& b) {
  return std::abs(a.normal.dot(b.normal)) < 1e-12;
}

/// The relations by which models/pipe-fitting.yaml tells the classes.
TEST(Fittings, RimsStandAsTheirClassSays) {
  auto tee = rims(make("tee"));
  EXPECT_TRUE(concentric(tee["rim1"], tee["rim2"]));
  EXPECT_TRUE(perpendicular(tee["rim1"], tee["rim3"]));
  auto cross = rims(make("cross", {{"run_length", 140}}));
  EXPECT_TRUE(concentric(cross["rim1"], cross["rim2"]));
  EXPECT_TRUE(concentric(cross["rim3"], cross["rim4"]));
  EXPECT_TRUE(perpendicular(cross["rim1"], cross["rim3"]));
  EXPECT_NEAR((cross["rim1"].center + cross["rim2"].center).norm(), 0, 1e-12) << "the runs halve each other";
  EXPECT_NEAR((cross["rim3"].center + cross["rim4"].center).norm(), 0, 1e-12);
  auto elbow = rims(make("elbow"));
  EXPECT_TRUE(perpendicular(elbow["rim1"], elbow["rim2"]));
  auto tricorner = rims(make("tricorner"));
  for (const auto& [a, b] : {std::pair("rim1", "rim2"), std::pair("rim1", "rim3"), std::pair("rim2", "rim3")})
    EXPECT_TRUE(perpendicular(tricorner[a], tricorner[b]));
  auto wye = rims(make("wye"));
  EXPECT_TRUE(concentric(wye["rim1"], wye["rim2"]));
  EXPECT_NEAR(wye["rim1"].normal.dot(wye["rim3"].normal), std::sqrt(0.5), 1e-12);
  EXPECT_LT((wye["rim1"].center - wye["rim3"].center).norm(), (wye["rim2"].center - wye["rim3"].center).norm());
}

TEST(Fittings, RimsThatAreNotThereAreEmpty) {
  const std::map<std::string, int> count = {{"tee", 3}, {"wye", 3}, {"cross", 4}, {"elbow", 2}, {"tricorner", 3}};
  for (const auto& [kind, expected] : count) {
    auto found = rims(make(kind));
    ASSERT_EQ(found.size(), 4U) << kind;
    for (int i = 1; i <= 4; ++i) EXPECT_EQ(found["rim" + std::to_string(i)].there, i <= expected) << kind << i;
  }
}

TEST(Fittings, WallHasItsThicknessEverywhereOnThePipes) {
  for (const char* kind : {"tee", "wye", "cross", "elbow", "tricorner"}) {
    const Solid solid = make(kind);
    for (const auto& [name, rim] : rims(solid)) {
      if (!rim.there) continue;
      const Vec3 aside = rim.normal.unitOrthogonal();
      const Vec3 axis = rim.center - 5 * rim.normal;  // beyond the rounded edge
      EXPECT_NEAR(solid.surface(axis + 16 * aside).value, 0, 1e-12) << kind << ": bore";
      EXPECT_NEAR(solid.surface(axis + 20 * aside).value, 0, 1e-12) << kind << ": outside";
      EXPECT_NEAR(solid.surface(axis + 18 * aside).value, -2, 1e-12) << kind << ": middle of the wall";
    }
  }
}

TEST(Elbow, BendIsATorus) {
  const Solid solid = make("elbow");
  const Vec3 center(30, 0, 30);
  for (const double turn : {0.3, 0.8, 1.2})
    for (const double around : {0.1, 1.7, 3.3, 5.0}) {
      const Vec3 out = Vec3(-std::cos(turn), 0, -std::sin(turn));
      const Vec3 spoke = std::cos(around) * out + std::sin(around) * Vec3::UnitY();
      for (const double radius : {16.0, 20.0})
        EXPECT_NEAR(solid.surface(center + 30 * out + radius * spoke).value, 0, 1e-9);
    }
}

TEST(Fittings, RefuseLengthsThatLeaveNoRoom) {
  const auto refused = [](const char* kind, const std::map<std::string, double>& parameters, const char* word) {
    try {
      make(kind, parameters);
      ADD_FAILURE() << kind << " was made";
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  refused("wye", {{"branch_length", 60}}, "branch_length is 60");
  refused("wye", {{"branch_angle", 80}}, "branch_angle is 80");
  refused("wye", {{"branch_angle", 200}}, "between -180 and 180");
  refused("elbow", {{"bend_radius", 22}}, "bend_radius is 22");
  refused("elbow", {{"leg1_length", 31}}, "leg1_length is 31");
  refused("cross", {{"cross_length", 50}}, "cross_length is 50");
  refused("tricorner", {{"leg3_length", 20}}, "leg3_length is 20");
}

}  // namespace
}  // namespace toposcope
