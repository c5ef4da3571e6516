// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

const double diagonal = std::sqrt(16.0 + 9 + 4);  // of the fixture's object box

Feature at(const Vec3& center, const Vec3& normal = Vec3::UnitZ()) {
  return circle_feature(center, normal, 1);
}

RelationResult distance(const std::string& way, const Settings& bounds, double tilt_sd = 0) {
  Feature axis = at({7, 7, 7}, Vec3::UnitZ());
  axis.shape.direction_sd = tilt_sd;
  Settings settings = bounds;
  settings.push_back({"way", way});
  return relate_all("distance", {at({0, 0, 0}), at({0.3, 0.4, 1.2}, Vec3::UnitX()), axis}, settings);
}

TEST(Distance, AlongAndAcrossTheThirdsAxis) {
  EXPECT_NEAR(distance("along", {{"max", "1"}}).residual, 0.2, 1e-12);
  EXPECT_NEAR(distance("along", {{"min", "1.5"}}).residual, 0.3, 1e-12);
  EXPECT_EQ(distance("along", {{"min", "1.1"}, {"max", "1.3"}}).residual, 0);
  EXPECT_NEAR(distance("across", {{"max", "0.4"}}).residual, 0.1, 1e-12);
  EXPECT_NEAR(distance("across", {{"min", "0.75"}}).residual, 0.25, 1e-12);
}

TEST(Distance, SaysWhatTheKernelNeeds) {
  const RelationResult along = distance("along", {{"max", "2"}}, 0.1), across = distance("across", {{"max", "2"}}, 0.1);
  EXPECT_NEAR(along.sd, 0.05, 1e-12) << "a tilt moves the height by what lies across";
  EXPECT_NEAR(across.sd, 0.12, 1e-12);
  EXPECT_NEAR(along.slack, 2, 1e-12);
  EXPECT_NEAR(along.tolerance, 0.01 * diagonal, 1e-12);
  EXPECT_NEAR(along.clutter_density, 1 / diagonal, 1e-12);
  EXPECT_NEAR(distance("along", {{"min", "1"}}).slack, diagonal - 1, 1e-12) << "no distance exceeds the diagonal";
}

TEST(Distance, NeedsAnAxis) {
  Feature ball = at({0, 0, 0});
  ball.shape.orientation = Orientation::none;
  EXPECT_FALSE(relate_all("distance", {at({0, 0, 0}), at({1, 0, 0}), ball}).applicable);
  EXPECT_ANY_THROW(distance("sideways", {}));
}

TEST(Distance, PoseAndScaleDoNotMatter) {
  for (const char* way : {"along", "across"})
    expect_pose_does_not_matter("distance", {at({0, 0, 0}), at({0.3, 0.4, 1.2}), at({1, 1, 1}, {1, 2, 2})},
                                {{"way", way}});
}

}  // namespace
