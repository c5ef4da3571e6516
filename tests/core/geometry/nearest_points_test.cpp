// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random.h"
#include "toposcope/geometry.h"

namespace toposcope {
namespace {

std::vector<Vec3> cloud(std::size_t count, test::Random& random) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(random.normal(), random.normal(), random.normal());
  return points;
}

TEST(LeastDistance, IsThatOfBruteForce) {
  test::Random random(3);
  for (const std::size_t count : {1U, 2U, 9U, 11U, 200U}) {
    const std::vector<Vec3> first = cloud(count, random), second = cloud(70, random);
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : first)
      for (const Vec3& q : second) least = std::min(least, (p - q).norm());
    EXPECT_NEAR(least_distance(first, second), least, 1e-15);
    EXPECT_EQ(least_distance(first, second), least_distance(second, first));
  }
  const std::vector<Vec3> same(30, Vec3(1, 2, 3));
  EXPECT_EQ(least_distance(same, same), 0);
}

}  // namespace
}  // namespace toposcope
