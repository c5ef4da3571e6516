// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

const double diagonal = std::sqrt(16.0 + 9 + 4);  // of the fixture's object box

Feature at(double x) {
  return circle_feature(Vec3(x, 0, 0), Vec3::UnitZ(), 1);
}

RelationResult apart(double distance, const char* min, const char* max, const Motion& motion = {}) {
  const auto scaled = [&](const char* text) { return std::to_string(std::stod(text) * motion.scale); };
  const Arguments arguments(PluginKind::relations, "centroid-distance", {{"min", scaled(min)}, {"max", scaled(max)}});
  return relate(*test::relation("centroid-distance"), at(0), at(distance), motion, arguments.options());
}

TEST(CentroidDistance, ResidualIsTheDistanceBeyondTheRange) {
  EXPECT_NEAR(apart(0.25, "0.5", "2").residual, 0.25, 1e-12);
  EXPECT_EQ(apart(0.5, "0.5", "2").residual, 0);
  EXPECT_EQ(apart(1, "0.5", "2").residual, 0);
  EXPECT_NEAR(apart(2.75, "0.5", "2").residual, 0.75, 1e-12);
}

TEST(CentroidDistance, SaysWhatTheKernelNeeds) {
  const RelationResult result = apart(1, "0.5", "2");
  EXPECT_NEAR(result.tolerance, 0.01 * diagonal, 1e-12);
  EXPECT_NEAR(result.slack, 1.5, 1e-12);
  EXPECT_NEAR(result.clutter_density, 1 / diagonal, 1e-12);
  EXPECT_EQ(result.dof, 1);
}

TEST(CentroidDistance, DeviationOfBothFitsAddsUp) {
  Feature first = at(0), second = at(1);
  first.shape.centroid_sd = 0.3;
  second.shape.centroid_sd = 0.4;
  const Arguments arguments(PluginKind::relations, "centroid-distance", {{"max", "2"}});
  const auto relation = test::relation("centroid-distance");
  EXPECT_NEAR(relate(*relation, first, second, {}, arguments.options()).sd, 0.5, 1e-12);
}

TEST(CentroidDistance, PoseScaleAndOrderDoNotMatter) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Motion motion = some_motion(seed);
    motion.scale = std::pow(2.0, static_cast<double>(seed) - 6);
    const RelationResult there = apart(2.75, "0.5", "2", motion);
    EXPECT_NEAR(there.residual / motion.scale, 0.75, 1e-4);  // the argument has six decimals
    EXPECT_NEAR(there.tolerance / motion.scale, 0.01 * diagonal, 1e-9);
    EXPECT_NEAR(there.clutter_density * motion.scale, 1 / diagonal, 1e-9);
  }
  const Arguments arguments(PluginKind::relations, "centroid-distance", {{"max", "1"}});
  const auto relation = test::relation("centroid-distance");
  EXPECT_EQ(relate(*relation, at(0), at(3), {}, arguments.options()).residual,
            relate(*relation, at(3), at(0), {}, arguments.options()).residual);
}

TEST(CentroidDistance, MaxMustBeGivenAndAboveMin) {
  EXPECT_ANY_THROW(Arguments(PluginKind::relations, "centroid-distance", {}));
  EXPECT_ANY_THROW(apart(1, "2", "1"));
}

}  // namespace
