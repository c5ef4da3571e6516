// SPDX-License-Identifier: BSD-3-Clause
// The smallest hitting set against all subsets.

#include "hitting_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "base/run_context.h"
#include "support/random.h"

namespace toposcope {
namespace {

using Sets = std::vector<std::vector<std::size_t>>;
constexpr std::size_t items = 9;

bool hits_all(const Sets& sets, std::uint32_t chosen) {
  return std::all_of(sets.begin(), sets.end(), [&](const std::vector<std::size_t>& set) {
    return std::any_of(set.begin(), set.end(), [&](std::size_t item) { return (chosen >> item & 1U) != 0; });
  });
}

/// items + 1 where no subset hits all.
std::size_t smallest_of_all(const Sets& sets) {
  std::size_t least = items + 1;
  for (std::uint32_t chosen = 0; chosen < 1U << items; ++chosen)
    if (hits_all(sets, chosen)) least = std::min<std::size_t>(least, static_cast<std::size_t>(std::popcount(chosen)));
  return least;
}

Sets random_sets(std::uint64_t seed) {
  test::Random random(seed);
  Sets sets(1 + random.below(8));
  for (std::vector<std::size_t>& set : sets) {
    for (std::size_t item = 0; item < items; ++item)
      if (random.chance(0.3)) set.push_back(item);
    if (set.empty() && random.chance(0.9)) set.push_back(random.below(items));
  }
  return sets;
}

TEST(HittingSet, IsTheSmallestOfAllSubsets) {
  const RunContext context;
  Deadline deadline(60, context);
  std::size_t without = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Sets sets = random_sets(seed);
    const std::size_t least = smallest_of_all(sets);
    std::vector<std::size_t> found;
    ASSERT_EQ(smallest_hitting_set(sets, items, items + 1, deadline, found), least <= items);
    if (least > items) {
      ++without;
      continue;
    }
    std::uint32_t chosen = 0;
    for (const std::size_t item : found) chosen |= 1U << item;
    EXPECT_EQ(found.size(), least);
    EXPECT_TRUE(hits_all(sets, chosen));
    EXPECT_FALSE(smallest_hitting_set(sets, items, least, deadline, found)) << "none is smaller than the limit";
  }
  EXPECT_GT(without, 5U);
  EXPECT_LT(without, 200U);
}

TEST(HittingSet, SaysNothingOutOfTime) {
  const RunContext context;
  Deadline deadline(0, context);
  Sets sets;
  for (std::size_t k = 0; k < 40; ++k) sets.push_back({k, (k * 7 + 3) % 40, (k * 11 + 5) % 40});
  std::vector<std::size_t> found;
  EXPECT_FALSE(smallest_hitting_set(sets, 40, 41, deadline, found));
}

}  // namespace
}  // namespace toposcope
