// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/system/random.h"

#include <gmock/gmock.h>

#include <random>

namespace toposcope {
namespace {

using testing::ElementsAre;

// Of the authors' own code (prng.di.unimi.it/splitmix64.c), state 1234567.
TEST(SplitMix64, MakesThePublishedNumbers) {
  SplitMix64 random(1234567);
  EXPECT_THAT((std::array{random(), random(), random()}),
              ElementsAre(6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL));
  EXPECT_EQ(splitmix64(1234567), 6457827717110365317ULL);
}

TEST(LinearCongruential, IsKnuths) {
  std::linear_congruential_engine<std::uint64_t, 6364136223846793005ULL, 1442695040888963407ULL, 0> engine(42);
  LinearCongruential random(42);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(random(), engine() >> 33);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(random.below(60), (engine() >> 33) % 60);
}

TEST(Uniform, EndsAsItsNameSays) {
  const std::uint64_t most = ~std::uint64_t{0};
  EXPECT_EQ(uniform_closed_open(0), 0);
  EXPECT_EQ(uniform_closed_open(most), 1 - 0x1p-53);
  EXPECT_EQ(uniform_open_closed(0), 0x1p-53);
  EXPECT_EQ(uniform_open_closed(most), 1);
  EXPECT_EQ(uniform_open(0), 0x1p-54);
}

TEST(NormalPair, HasMomentsOfTwoIndependentStandardNormals) {
  SplitMix64 random(3);
  const int count = 100000;
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0, xy = 0, x4 = 0;
  for (int i = 0; i < count; ++i) {
    const double u = uniform_open(random());
    const auto [x, y] = normal_pair(u, uniform_open(random()));
    x1 += x / count, y1 += y / count, x2 += x * x / count, y2 += y * y / count, xy += x * y / count;
    x4 += x * x * x * x / count;
  }
  // 5 standard deviations of each mean.
  EXPECT_NEAR(x1, 0, 0.016);
  EXPECT_NEAR(y1, 0, 0.016);
  EXPECT_NEAR(xy, 0, 0.016);
  EXPECT_NEAR(x2, 1, 0.023);
  EXPECT_NEAR(y2, 1, 0.023);
  EXPECT_NEAR(x4, 3, 0.16);
}

}  // namespace
}  // namespace toposcope
