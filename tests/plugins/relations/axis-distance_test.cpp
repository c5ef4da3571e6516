// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

const double diagonal = std::sqrt(16.0 + 9 + 4);  // of the fixture's object box

/// A circle about the z axis and a segment whose middle is `offset` beside it, `height` above it.
RelationResult beside(double offset, double height, const Motion& motion = {}, double direction_sd = 0) {
  const Arguments arguments(PluginKind::relations, "axis-distance",
                            {{"min", std::to_string(0.5 * motion.scale)}, {"max", std::to_string(2 * motion.scale)}});
  Feature circle = circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1);
  circle.shape.direction_sd = direction_sd;
  const Feature segment = segment_feature(Vec3(offset, -1, height), Vec3(offset, 1, height));
  return relate(*test::relation("axis-distance"), circle, segment, motion, arguments.options());
}

TEST(AxisDistance, IsMeasuredAcrossTheAxisAlone) {
  for (double height : {-3.0, 0.0, 5.0}) {
    EXPECT_NEAR(beside(0, height).residual, 0.5, 1e-12);
    EXPECT_NEAR(beside(0.25, height).residual, 0.25, 1e-12);
    EXPECT_NEAR(beside(1, height).residual, 0, 1e-12);
    EXPECT_NEAR(beside(-1, height).residual, 0, 1e-12);
    EXPECT_NEAR(beside(2.75, height).residual, 0.75, 1e-12);
  }
}

TEST(AxisDistance, SaysWhatTheKernelNeeds) {
  const RelationResult result = beside(1, 3, {}, 0.1);
  EXPECT_NEAR(result.tolerance, 0.01 * diagonal, 1e-12);
  EXPECT_NEAR(result.slack, 1.5, 1e-9);
  EXPECT_NEAR(result.clutter_density, 1 / diagonal, 1e-12);
  EXPECT_NEAR(result.sd, 0.3, 1e-12) << "a tilt of the axis moves it by the height";
}

TEST(AxisDistance, PoseAndScaleDoNotMatter) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Motion motion = some_motion(seed);
    motion.scale = std::pow(2.0, static_cast<double>(seed) - 6);
    EXPECT_NEAR(beside(2.75, 1, motion).residual / motion.scale, 0.75, 1e-4);  // the argument has six decimals
  }
}

TEST(AxisDistance, NeedsAnAxisAndARange) {
  const Arguments arguments(PluginKind::relations, "axis-distance", {{"max", "2"}});
  Feature blob = circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1);
  blob.shape.orientation = Orientation::none;
  const RelationResult result = relate(*test::relation("axis-distance"), blob,
                                       segment_feature(Vec3::Zero(), Vec3::UnitX()), {}, arguments.options());
  EXPECT_FALSE(result.applicable);
  EXPECT_NE(result.why, "");
  const Arguments none(PluginKind::relations, "axis-distance", {{"min", "1"}});
  EXPECT_ANY_THROW(relate(*test::relation("axis-distance"), circle_feature(Vec3::Zero(), Vec3::UnitZ(), 1),
                          segment_feature(Vec3::Zero(), Vec3::UnitX()), {}, none.options()));
}

/// Beside a circle of radius 2.
RelationResult in_radii(double offset, const Settings& settings, const Motion& motion = {}) {
  const Arguments arguments(PluginKind::relations, "axis-distance", settings);
  return relate(*test::relation("axis-distance"), circle_feature(Vec3::Zero(), Vec3::UnitZ(), 2),
                segment_feature(Vec3(offset, -1, 5), Vec3(offset, 1, 5)), motion, arguments.options());
}

TEST(AxisDistance, InRadiiOfTheFirst) {
  const Settings half_to_one = {{"min_radii", "0.5"}, {"max_radii", "1"}};
  EXPECT_NEAR(in_radii(0.75, half_to_one).residual, 0.25, 1e-12);
  EXPECT_NEAR(in_radii(1.5, half_to_one).residual, 0, 1e-12);
  EXPECT_NEAR(in_radii(2.5, half_to_one).residual, 0.5, 1e-12);
  EXPECT_NEAR(in_radii(1.5, half_to_one).slack, 1, 1e-12);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Motion motion = some_motion(seed);
    EXPECT_NEAR(in_radii(2.5, half_to_one, motion).residual / motion.scale, 0.5, 1e-9) << "no length in the model";
  }
  EXPECT_NEAR(in_radii(1.5, {{"max", "1.2"}, {"max_radii", "1"}}).residual, 0.3, 1e-12) << "both bound it";
  EXPECT_ANY_THROW(in_radii(1, {{"min_radii", "2"}, {"max_radii", "1"}}));
}

TEST(AxisDistance, RadiiNeedARadius) {
  const Arguments arguments(PluginKind::relations, "axis-distance", {{"max_radii", "1"}});
  const RelationResult result = relate(*test::relation("axis-distance"), segment_feature(Vec3::Zero(), Vec3::UnitZ()),
                                       segment_feature(Vec3(1, 0, 0), Vec3(1, 1, 0)), {}, arguments.options());
  EXPECT_FALSE(result.applicable);
}

}  // namespace
