// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/representatives.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.h"

namespace toposcope {
namespace {

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

TEST(Representatives, AreEvenlySpreadOverTheDistances) {
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) points.push_back(Vec3(5 + i, 0, 0));
  const std::vector<Vec3> chosen = representatives(points, Vec3(5, 0, 0), 10);
  ASSERT_EQ(chosen.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(chosen[k].x(), 5 + 10 * static_cast<double>(k));
}

TEST(Representatives, AreAllWhereThereAreFew) {
  const std::vector<Vec3> points = {{3, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  std::vector<Vec3> chosen = representatives(points, Vec3::Zero(), 10);
  std::sort(chosen.begin(), chosen.end(), before);
  EXPECT_EQ(chosen, (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  EXPECT_TRUE(representatives({}, Vec3::Zero(), 10).empty());
}

TEST(Representatives, DoNotDependOnTheOrder) {
  test::Random random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < 50; ++i) points.push_back({random.normal(), random.normal(), random.normal()});
  const std::vector<Vec3> chosen = representatives(points, Vec3::Zero(), 7);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(representatives(points, Vec3::Zero(), 7), chosen);
}

}  // namespace
}  // namespace toposcope
