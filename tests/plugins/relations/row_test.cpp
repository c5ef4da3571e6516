// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

std::vector<Feature> row(const std::vector<double>& places) {
  std::vector<Feature> all;
  for (const double place : places)
    all.push_back(circle_feature(Vec3(1, 2, 3) + place * Vec3(2, 1, 2) / 3, Vec3::UnitZ(), 0.1));
  return all;
}

TEST(Row, EqualDistancesInAnyOrder) {
  EXPECT_NEAR(relate_all("row", row({0, 1, 2, 3})).residual, 0, 1e-9);
  EXPECT_NEAR(relate_all("row", row({2, 0, 3, 1})).residual, 0, 1e-9);
  EXPECT_NEAR(relate_all("row", row({2, 0, 3, 1})).tolerance, 0.05, 1e-9);
}

/// 0, 1, 3 lie nearest to -1/6, 4/3, 17/6.
TEST(Row, TheResidualIsThatOfTheRegressionLine) {
  const double squares = (1.0 / 36 + 1.0 / 9 + 1.0 / 36) / 3;
  EXPECT_NEAR(relate_all("row", row({0, 1, 3})).residual, std::sqrt(squares), 1e-9);
  EXPECT_NEAR(relate_all("row", row({0, 1, 3}), {{"equal", "false"}}).residual, 0, 1e-9);
  std::vector<Feature> bent = row({0, 1, 2});
  bent[1].shape.centroid += 0.3 * Vec3(1, -2, 0).normalized();
  EXPECT_NEAR(relate_all("row", bent).residual, std::sqrt((0.01 + 0.04 + 0.01) / 3), 1e-9);
}

TEST(Row, TheModelMayBoundTheDistance) {
  EXPECT_NEAR(relate_all("row", row({0, 1, 2}), {{"max", "0.75"}}).residual, 0.25, 1e-9);
  EXPECT_NEAR(relate_all("row", row({0, 1, 2}), {{"min", "1.5"}}).residual, 0.5, 1e-9);
}

TEST(Row, SaysWhatTheKernelNeeds) {
  EXPECT_EQ(relate_all("row", row({0, 1, 2})).dof, 3);
  EXPECT_EQ(relate_all("row", row({0, 1, 2}), {{"equal", "false"}}).dof, 2);
  std::vector<Feature> three = row({0, 1, 2});
  for (Feature& each : three) each.shape.centroid_sd = 0.3;
  EXPECT_NEAR(relate_all("row", three).sd, 0.3 / std::sqrt(3.0), 1e-12);
}

TEST(Row, OnePlaceIsNone) {
  EXPECT_FALSE(relate_all("row", row({1, 1, 1})).applicable);
}

TEST(Row, PoseAndScaleDoNotMatter) {
  std::vector<Feature> uneven = row({0, 1, 2.2, 3});
  uneven[2].shape.centroid += Vec3(0.2, -0.1, 0.1);
  expect_pose_does_not_matter("row", uneven);
}

}  // namespace
