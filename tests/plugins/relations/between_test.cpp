// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

Feature at(const Vec3& center) {
  return circle_feature(center, Vec3::UnitZ(), 1);
}

RelationResult between(const Vec3& self, const Settings& settings = {}) {
  return relate_all("between", {at(self), at({1, 0, 0}), at({3, 0, 0})}, settings);
}

TEST(Between, OnTheWayOfTheOuterTwo) {
  EXPECT_EQ(between({2, 0, 0}).residual, 0);
  EXPECT_EQ(between({1, 0, 0}).residual, 0);
  EXPECT_EQ(between({2.9, 5, -4}).residual, 0) << "beside the way is between too";
  EXPECT_NEAR(between({0.5, 2, 0}).residual, 0.5, 1e-12);
  EXPECT_NEAR(between({4, 0, 0}).residual, 1, 1e-12);
  EXPECT_NEAR(between({1.1, 0, 0}, {{"margin", "0.25"}}).residual, 0.4, 1e-12);
}

TEST(Between, SaysWhatTheKernelNeeds) {
  const RelationResult result = between({2, 0, 0});
  EXPECT_NEAR(result.slack, 2, 1e-12);
  EXPECT_NEAR(result.tolerance, 0.04, 1e-12);
  EXPECT_NEAR(result.clutter_density, 1 / std::sqrt(29.0), 1e-12);
  Feature unsure = at({2, 0, 3});
  unsure.shape.centroid_sd = 0.3;
  Feature end = at({3, 0, 0});
  end.shape.centroid_sd = 0.4;
  const RelationResult turned = relate_all("between", {unsure, at({1, 0, 0}), end});
  EXPECT_NEAR(turned.sd, std::hypot(0.3, 0.4, 3 * 0.2), 1e-12) << "an unsure end turns the way";
}

TEST(Between, TwoInOnePlaceHaveNothingBetween) {
  EXPECT_FALSE(relate_all("between", {at({0, 0, 0}), at({1, 0, 0}), at({1, 0, 0})}).applicable);
}

TEST(Between, PoseAndScaleDoNotMatter) {
  expect_pose_does_not_matter("between", {at({5, 1, 0}), at({1, 0, 0}), at({3, 1, 1})}, {{"margin", "0.1"}});
}

}  // namespace
