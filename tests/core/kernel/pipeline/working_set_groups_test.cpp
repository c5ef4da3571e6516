// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/working_set_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/refusal.h"

namespace toposcope {
namespace {

/// Pairs of sets, of which the two overlap: no group has more sets than there are pairs.
MeasuredWorkingSets pairs_of_sets(Index pairs) {
  MeasuredWorkingSets sets;
  sets.type_names = {"concave"};
  sets.types.assign(2 * pairs, 0);
  sets.overlap = BitMatrix(2 * pairs);
  for (Index s = 0; s < 2 * pairs; ++s) {
    sets.overlap.set(s, s);
    sets.overlap.set(s, s ^ 1U);
  }
  return sets;
}

TEST(WorkingSetGroups, EachGroupOfDisjointSetsComesOnce) {
  const ModelFeature feature;
  EXPECT_EQ(WorkingSetGroups(feature, std::vector<std::string>(3, "concave"), pairs_of_sets(4)).size(), 4U * 8);
}

TEST(WorkingSetGroups, MoreSetsThanCanBeLookedThroughAreRefused) {
  ModelFeature feature;
  feature.name = "handle";
  for (const std::size_t arity : {16, 20}) {
    const std::vector<std::string> types(arity, "concave");
    EXPECT_THAT(test::refusal([&] { WorkingSetGroups(feature, types, pairs_of_sets(19)); }),
                ::testing::AllOf(::testing::HasSubstr("feature 'handle'"), ::testing::HasSubstr("groups of")))
        << arity;
  }
}

}  // namespace
}  // namespace toposcope
