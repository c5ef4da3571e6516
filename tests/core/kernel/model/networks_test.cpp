// SPDX-License-Identifier: BSD-3-Clause
#include "model/networks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace toposcope {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> told(const AbstractModel& model, Index object) {
  std::vector<std::string> lines;
  for (const Link& link : links_from(model, object)) lines.push_back(link.kind + " " + model.objects[link.to].name);
  return lines;
}

Link link(Index from, Index to, const std::string& kind = "has-part") {
  return {from, to, kind, {}};
}

TEST(Networks, EveryLinkHasItsInverse) {
  AbstractModel model;
  for (const auto& [name, dimension] : {std::pair{"cup", 3}, {"body", 3}, {"wall", 2}, {"rim", 1}, {"edge", 1}})
    model.objects.push_back({name, dimension, {}});
  model.parts = {link(0, 1)};
  model.topology = {link(1, 2, "bounded-by"), link(2, 3, "bounded-by"), link(2, 4, "bounded-by")};
  model.associations = {link(3, 4, "up"), link(0, 1, "adjacent-to")};

  EXPECT_THAT(told(model, 0), ElementsAre("has-part body", "adjacent-to body"));
  EXPECT_THAT(told(model, 1), ElementsAre("bounded-by wall", "part-of cup", "adjacent-to cup"));
  EXPECT_THAT(told(model, 2), ElementsAre("boundary-of body", "bounded-by rim", "bounded-by edge"));
  EXPECT_THAT(told(model, 3), ElementsAre("boundary-of wall", "up edge"));
  EXPECT_THAT(told(model, 4), ElementsAre("boundary-of wall", "down rim"));
}

TEST(Networks, AnInverseTwiceIsTheLinkItself) {
  for (const char* kind : {"bounded-by", "boundary-of", "has-part", "part-of", "adjacent-to", "up", "down", "front",
                           "back", "right", "left"})
    EXPECT_EQ(inverse_of(inverse_of(kind)), kind);
  EXPECT_EQ(inverse_of("left"), "right");
  EXPECT_EQ(inverse_of("front"), "back");
  EXPECT_EQ(inverse_of("beside"), "");
}

TEST(Networks, FindsACycleAndNothingElse) {
  EXPECT_THAT(find_cycle(4, {link(0, 1), link(1, 2), link(0, 2), link(3, 2)}), IsEmpty()) << "a diamond is no cycle";
  EXPECT_THAT(find_cycle(4, {link(0, 1), link(1, 2), link(2, 3), link(3, 1)}), ElementsAre(1, 2, 3));
  EXPECT_THAT(find_cycle(2, {link(1, 1)}), ElementsAre(1));
  EXPECT_THAT(find_cycle(0, {}), IsEmpty());
}

TEST(Networks, FollowsLongChains) {
  std::vector<Link> chain;
  constexpr Index count = 200000;
  for (Index i = 0; i + 1 < count; ++i) chain.push_back(link(i, i + 1));
  EXPECT_THAT(find_cycle(count, chain), IsEmpty());
  chain.push_back(link(count - 1, 0));
  EXPECT_EQ(find_cycle(count, chain).size(), count);
}

}  // namespace
}  // namespace toposcope
