// SPDX-License-Identifier: BSD-3-Clause
#include "relation_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

Feature circle(double radius, double sd = 0) {
  Feature feature = circle_feature(Vec3(radius, 0, 0), Vec3::UnitZ(), radius);
  feature.shape.measures[0].sd = sd;
  return feature;
}

TEST(SameSize, ResidualIsTheDifference) {
  const auto relation = test::relation("same-size");
  const RelationResult result = relate(*relation, circle(1, 0.3), circle(1.5, 0.4));
  EXPECT_NEAR(result.residual, 0.5, 1e-12);
  EXPECT_NEAR(result.tolerance, 0.125, 1e-12) << "a tenth of the mean";
  EXPECT_NEAR(result.sd, 0.5, 1e-12);
  EXPECT_NEAR(result.clutter_density, 1 / 2.5, 1e-12);
  EXPECT_EQ(relate(*relation, circle(2), circle(2)).residual, 0);
  expect_invariant(*relation, circle(1), circle(1.5), 1);
}

TEST(SameSize, TheDensityOfUnrelatedSizesSumsToOne) {
  // Two numbers of mean m differ by 0 to 2 m.
  const RelationResult result = relate(*test::relation("same-size"), circle(0.5), circle(3.5));
  EXPECT_NEAR(result.clutter_density * 2 * 2, 1, 1e-12);
}

TEST(SameSize, ComparesTheFirstMeasureInCommon) {
  Feature first = circle(1), second = circle(3);
  second.shape.measures.insert(second.shape.measures.begin(), Measure{"coverage", 0.5, 0});
  EXPECT_NEAR(relate(*test::relation("same-size"), first, second).residual, 2, 1e-12);
  EXPECT_FALSE(relate(*test::relation("same-size"), first, segment_feature(Vec3::Zero(), Vec3::UnitX())).applicable);
}

}  // namespace
