// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

Vec3 at_angle(double degrees) {
  return {std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180)};
}

RelationResult between(double degrees, const char* min, const char* max, bool line = false) {
  const Arguments arguments(PluginKind::relations, "angle", {{"min", min}, {"max", max}});
  const Feature second =
      line ? segment_feature(Vec3::Zero(), at_angle(degrees)) : circle_feature(Vec3::Zero(), at_angle(degrees), 1);
  return relate(*test::relation("angle"), circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1), second, {},
                arguments.options());
}

TEST(Angle, ResidualIsTheAngleBeyondTheRange) {
  EXPECT_NEAR(between(20, "30", "60").residual, 10 * pi / 180, 1e-12);
  EXPECT_NEAR(between(45, "30", "60").residual, 0, 1e-12);
  EXPECT_NEAR(between(75, "30", "60").residual, 15 * pi / 180, 1e-12);
  EXPECT_NEAR(between(135, "30", "60").residual, 0, 1e-12) << "lines have no sense";
}

TEST(Angle, ALineIsComparedWithThePlaneNotItsNormal) {
  EXPECT_NEAR(between(75, "30", "60", true).residual, 15 * pi / 180, 1e-12) << "15 degrees from the plane";
  EXPECT_NEAR(between(45, "30", "60", true).residual, 0, 1e-12);
}

TEST(Angle, SaysWhatTheKernelNeeds) {
  const RelationResult result = between(45, "30", "60");
  EXPECT_NEAR(result.tolerance, 5 * pi / 180, 1e-12);
  EXPECT_NEAR(result.slack, 30 * pi / 180, 1e-12);
  EXPECT_NEAR(result.clutter_density, std::sin(pi / 4), 1e-12);
  EXPECT_EQ(result.dof, 1);
}

TEST(Angle, PoseScaleAndOrderDoNotMatter) {
  const Arguments arguments(PluginKind::relations, "angle", {{"min", "60"}, {"max", "80"}});
  const auto relation = test::relation("angle");
  const Feature first = circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1);
  const Feature second = circle_feature(Vec3(1, 2, 3), at_angle(50), 2);
  for (std::uint64_t seed = 0; seed <= 12; ++seed) {
    const Motion motion = seed == 0 ? Motion{} : some_motion(seed);
    EXPECT_NEAR(relate(*relation, first, second, motion, arguments.options()).residual, 10 * pi / 180, 1e-9);
    EXPECT_NEAR(relate(*relation, second, first, motion, arguments.options()).residual, 10 * pi / 180, 1e-9);
  }
}

TEST(Angle, MinMustNotExceedMaxAndShapesNeedADirection) {
  EXPECT_ANY_THROW(between(45, "60", "30"));
  Feature none = circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1);
  none.shape.orientation = Orientation::none;
  const Arguments arguments(PluginKind::relations, "angle");
  EXPECT_FALSE(relate(*test::relation("angle"), none, none, {}, arguments.options()).applicable);
}

}  // namespace
