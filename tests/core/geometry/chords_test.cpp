// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/chords.h"

#include <gtest/gtest.h>

#include <cmath>

namespace toposcope {
namespace {

std::vector<double> polygon(int corners, int of, int times = 1) {
  std::vector<double> angles;
  for (int k = 0; k < times; ++k)
    for (int i = 0; i < corners; ++i) angles.push_back(std::remainder(2 * pi * (i + 0.3) / of, 2 * pi));
  return angles;
}

TEST(Chords, OfAPolygonLieAsDeepAsItsSides) {
  for (const int n : {3, 8, 12, 96, 200}) {
    EXPECT_NEAR(typical_sagitta(polygon(n, n), 5), 5 * (1 - std::cos(pi / n)), 1e-9) << n;
    // Rings one above the other, and half a turn of it.
    EXPECT_NEAR(typical_sagitta(polygon(n, n, 3), 5), 5 * (1 - std::cos(pi / n)), 1e-9) << n;
    if (n >= 8) {
      EXPECT_NEAR(typical_sagitta(polygon(n / 2 + 1, n), 5), 5 * (1 - std::cos(pi / n)), 1e-9) << n;
    }
  }
  EXPECT_EQ(typical_sagitta({}, 1), 0);
  EXPECT_EQ(typical_sagitta({1}, 1), 0);
}

TEST(Chords, ADeviationOfTheCurvatureReachesFartherOutThanIn) {
  EXPECT_NEAR(curvature_stretch(0), 1, 1e-12);
  // Curvature 1 / r less two deviations of it, a tenth of it each, is that of a radius of r / (1 - 0.2).
  EXPECT_NEAR(1 + 2 * 0.1 * curvature_stretch(0.1), 1 / (1 - 0.2), 1e-12);
  EXPECT_NEAR(curvature_stretch(0.45), 5, 1e-9);
}

TEST(Chords, PointsOnOneSideAreNotAsWellSpread) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(3, 3), some = all;
  EXPECT_TRUE(as_well_spread(some, all));
  some(0, 0) = 0.2;
  EXPECT_TRUE(as_well_spread(some, all));
  some(0, 0) = 0.05;
  EXPECT_FALSE(as_well_spread(some, all));
  some = Eigen::MatrixXd::Identity(3, 3);
  some(0, 1) = some(1, 0) = 0.95;
  EXPECT_FALSE(as_well_spread(some, all));
  EXPECT_FALSE(as_well_spread(all, Eigen::MatrixXd::Zero(3, 3)));
}

}  // namespace
}  // namespace toposcope
