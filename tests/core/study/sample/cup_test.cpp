// SPDX-License-Identifier: BSD-3-Clause
#include "sample/cup.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "base/errors.h"
#include "core/study/sample/sample_fixture.h"

namespace toposcope {
namespace {

ParameterValues parameters(const std::map<std::string, double>& given) {
  return check_parameters(cup_kind(), given);
}

using test::feature;

TEST(CupSide, PassesThroughItsEndsAndIsSmooth) {
  for (const double bulge : {-4.0, 0.0, 6.0}) {
    const CupSide side(30, 40, 90, bulge, 40);
    EXPECT_NEAR(side.radius(0), 30, 1e-12);
    EXPECT_NEAR(side.radius(90), 40, 1e-12);
    constexpr double step = 0.01;
    for (double z = step; z < 90 - step; z += step) {
      const double bend = side.radius(z - step) - 2 * side.radius(z) + side.radius(z + step);
      EXPECT_LT(std::abs(bend), 1.5 * step * step / (bulge == 0 ? 1e9 : side.arc()) + 1e-11) << z;
    }
    const double line = 30 + 10 * 40 / 90.0;
    EXPECT_EQ(side.radius(40) > line + 1, bulge > 0);
    EXPECT_EQ(side.radius(40) < line - 1, bulge < 0);
  }
}

TEST(Cup, CurvedWallHasItsThicknessEverywhere) {
  for (const double bulge : {-4.0, 6.0}) {
    const ParameterValues values = parameters({{"handle", 0}, {"curved", 1}, {"bulge", bulge}});
    const Cup cup(values);
    const Solid solid = make_cup(values);
    for (double z = 20; z < 85; z += 1.7) {
      const Vec3 outside(cup.side.radius(z), 0, z);
      ASSERT_NEAR(solid.surface(outside).value, 0, 1e-9);
      const Vec3 normal = solid.surface(outside).gradient;
      EXPECT_NEAR(solid.surface(outside - 4 * normal).value, 0, 1e-9);
      EXPECT_NEAR(solid.surface(outside - 2 * normal).value, -2, 1e-9);
    }
  }
}

TEST(Cup, FootRingStandsAndItsBottomIsRecessed) {
  const Solid solid = make_cup(parameters({{"foot_ring", 1}}));
  EXPECT_NEAR(solid.surface(Vec3(0, 0, 3)).value, 0, 1e-12);
  EXPECT_NEAR(solid.surface(Vec3(0, 0, 8)).value, 0, 1e-12) << "the bottom keeps its thickness";
  EXPECT_NEAR(solid.surface(Vec3(31, 0, 0)).value, 0, 1e-12) << "the ring stands on z = 0";
  for (const Vec3& p : feature(solid.features, "bottom").points) {
    EXPECT_EQ(p.z(), 3);
    EXPECT_LT(p.head<2>().norm(), 35 - 7);
  }
  EXPECT_LT(feature(solid.features, "bottomEdge").points.front().z(), 3);
}

TEST(Cup, EveryHandleShapeHasAHoleAndMeetsTheWallTwice) {
  for (int shape = 0; shape < 4; ++shape) {
    SCOPED_TRACE(shape);
    const ParameterValues values = parameters({{"handle_shape", shape}});
    const Cup cup(values);
    const Solid solid = make_cup(values);
    EXPECT_GT(handle_gap(cup), 0.4 * 5);
    EXPECT_GT(solid.surface(Vec3(cup.side.radius(50) + 6, 0, 50)).value, 0) << "the hole";
    const TruthFeature& handle = feature(solid.features, "handleCon");
    ASSERT_EQ(handle.groups.size(), 2U);
    for (const TruthGroup& group : handle.groups)
      for (const Index i : group.members)
        EXPECT_NEAR(handle.points[i].z(), group.name == "upper" ? 77 : 23, 5 + 4 + 1.5);
    for (const Vec3& p : handle.points) EXPECT_NEAR(solid.surface(p).value, 0, 1e-9);
  }
}

TEST(Cup, CentroidsOfTheHandlesRingsDoNotHangOnTheMesh) {
  const Sample coarse = test::make({.kind = "cup", .faces = 2000});
  const Sample fine = test::make({.kind = "cup", .faces = 30000});
  const TruthFeature &few = feature(coarse.truth.features, "handleCon"),
                     &many = feature(fine.truth.features, "handleCon");
  EXPECT_LT(few.points.size(), many.points.size()) << "marks whose vertex is taken are dropped";
  for (std::size_t g = 0; g < 2; ++g) EXPECT_EQ(few.groups[g].centroid, many.groups[g].centroid);
  // The ring is a line: its centroid is the mean along it, not that of points that lie closer on one side.
  for (const TruthGroup& group : many.groups) {
    Vec3 moment = Vec3::Zero();
    double length = 0;
    for (std::size_t i = 0; i < group.members.size(); ++i) {
      const Vec3 &a = many.points[group.members[i]], &b = many.points[group.members[(i + 1) % group.members.size()]];
      moment += (b - a).norm() * (a + b) / 2;
      length += (b - a).norm();
    }
    EXPECT_LT((moment / length - group.centroid).norm(), 0.1);
  }
}

TEST(Cup, RefusesWhatDoesNotFit) {
  const auto refused = [](const std::map<std::string, double>& given, const char* word) {
    try {
      make_cup(parameters(given));
      ADD_FAILURE() << word;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  refused({{"curved", 1}, {"bulge", 60}}, "lean at most");
  refused({{"curved", 1}, {"bulge_height", 80}}, "bulge_height is 80");
  refused({{"foot_ring", 1}, {"ring_width", 2}}, "ring_width is 2");
  refused({{"foot_ring", 1}, {"ring_depth", 20}}, "ring_depth is 20");
  refused({{"handle_shape", 4}}, "handle_shape is 4");
}

}  // namespace
}  // namespace toposcope
