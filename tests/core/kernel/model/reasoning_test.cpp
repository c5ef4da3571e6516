// SPDX-License-Identifier: BSD-3-Clause
#include "model/reasoning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "model/networks.h"
#include "model/read_model.h"

namespace toposcope {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A box of two halves: each has a wall, and they share a floor; the lid lies on both.
const AbstractModel& box() {
  static const AbstractModel model = model_from_text(R"(schema: toposcope.model/1
name: box
objects:
  box: volume
  near: volume
  far: volume
  knob: volume
  outside: surface
  wall: surface
  floor: surface
  edge: line
  corner: point
topology:
  box: [outside]
  near: [wall, floor]
  far: [floor]
  wall: [edge]
  floor: [edge]
  edge: [corner]
parts:
  box: [near, far, knob]
  outside: [wall]
associations:
  - {from: knob, up: near, adjacent-to: far}
  - {from: near, up: far}
)",
                                                     "box.yaml", nullptr)
                                         .abstract;
  return model;
}

Index object(const std::string& name) {
  for (Index i = 0; i < box().objects.size(); ++i)
    if (box().objects[i].name == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

/// "floor edge corner": what the chain of each consequence passes.
std::vector<std::string> follows(const std::string& subject, const char* relation) {
  std::vector<std::string> all;
  for (const Consequence& each : consequences(box(), object(subject), relation)) {
    EXPECT_EQ(each.chain.front().from, object(subject));
    EXPECT_EQ(each.chain.back().to, each.object);
    std::string line;
    for (const Link& link : each.chain) line += (line.empty() ? "" : " ") + box().objects[link.to].name;
    all.push_back(line);
  }
  return all;
}

TEST(Reasoning, BoundariesOfBoundariesAndTheirPartsBound) {
  EXPECT_THAT(follows("near", "bounded-by"), ElementsAre("wall", "floor", "wall edge", "wall edge corner"));
  EXPECT_THAT(follows("box", "bounded-by"),
              ElementsAre("outside", "outside wall", "outside wall edge", "outside wall edge corner"));
  EXPECT_THAT(follows("corner", "bounded-by"), IsEmpty());
  EXPECT_THAT(follows("corner", "boundary-of"), ElementsAre("edge", "edge wall", "edge floor", "edge wall near",
                                                            "edge floor far", "edge wall outside box"));
}

TEST(Reasoning, PartsAndDirectionsAreTransitive) {
  EXPECT_THAT(follows("knob", "up"), ElementsAre("near", "near far"));
  EXPECT_THAT(follows("far", "down"), ElementsAre("near", "near knob"));
  EXPECT_THAT(follows("far", "up"), IsEmpty());
  EXPECT_THAT(follows("wall", "part-of"), ElementsAre("outside"));
  EXPECT_THAT(follows("box", "has-part"), ElementsAre("near", "far", "knob"));
  EXPECT_THAT(follows("box", "up"), IsEmpty()) << "a direction of parts says nothing of the whole";
}

TEST(Reasoning, WhatSharesABoundaryIsAdjacent) {
  EXPECT_THAT(follows("near", "adjacent-to"), ElementsAre("floor far"));
  EXPECT_THAT(follows("far", "adjacent-to"), ElementsAre("knob", "floor near"));
  EXPECT_THAT(follows("floor", "adjacent-to"), ElementsAre("edge wall", "edge wall outside"))
      << "and what that is part of";
  EXPECT_THAT(follows("box", "adjacent-to"), IsEmpty()) << "parts of it, and no others, are adjacent";
}

/// Against closures that are made by hand: of random networks every relation is the inverse of its inverse, parts and
/// directions are the transitive closure, and bounds that of steps down after a first one.
TEST(Reasoning, IsTheClosureOfRandomNetworks) {
  std::mt19937 random(7);
  for (int round = 0; round < 60; ++round) {
    AbstractModel model;
    const Index n = 4 + round % 9;
    for (Index i = 0; i < n; ++i)
      model.objects.push_back({"o" + std::to_string(i), 3 - static_cast<int>(i * 4 / n), {}});
    const auto draw = [&](std::vector<Link>& network, const char* kind, int step) {
      for (Index from = 0; from < n; ++from)
        for (Index to = from + 1; to < n; ++to)
          if (model.objects[from].dimension - model.objects[to].dimension == step && random() % 3 == 0)
            network.push_back({from, to, kind, {}});
    };
    draw(model.topology, "bounded-by", 1);
    draw(model.parts, "has-part", 0);
    draw(model.associations, "up", 0);

    using Pairs = std::set<std::pair<Index, Index>>;
    const auto told = [&](const char* relation) {
      Pairs pairs;
      for (Index from = 0; from < n; ++from)
        for (const Consequence& each : consequences(model, from, relation)) pairs.emplace(from, each.object);
      return pairs;
    };
    const auto turned = [](const Pairs& pairs) {
      Pairs other;
      for (const auto& [from, to] : pairs) other.emplace(to, from);
      return other;
    };
    const auto closed = [&](Pairs pairs) {
      for (Index via = 0; via < n; ++via)
        for (Index from = 0; from < n; ++from)
          for (Index to = 0; to < n; ++to)
            if (pairs.contains({from, via}) && pairs.contains({via, to})) pairs.emplace(from, to);
      return pairs;
    };
    const auto written = [](const std::vector<Link>& network) {
      Pairs pairs;
      for (const Link& link : network) pairs.emplace(link.from, link.to);
      return pairs;
    };
    EXPECT_EQ(told("has-part"), closed(written(model.parts)));
    EXPECT_EQ(told("up"), closed(written(model.associations)));
    Pairs steps = written(model.topology), down = steps;
    steps.merge(written(model.parts));
    const Pairs below = closed(steps);
    Pairs bounds = down;
    for (const auto& [from, to] : down)
      for (Index end = 0; end < n; ++end)
        if (below.contains({to, end})) bounds.emplace(from, end);
    EXPECT_EQ(told("bounded-by"), bounds);
    for (const char* relation : {"bounded-by", "has-part", "up", "adjacent-to"})
      EXPECT_EQ(told(std::string(inverse_of(relation)).c_str()), turned(told(relation))) << relation;
  }
}

TEST(Reasoning, FollowsLongChains) {
  AbstractModel model;
  constexpr Index count = 20000;
  for (Index i = 0; i < count; ++i) model.objects.push_back({"o" + std::to_string(i), 1, {}});
  for (Index i = 0; i + 1 < count; ++i) model.associations.push_back({i, i + 1, "up", {}});
  EXPECT_EQ(consequences(model, count - 1, "up").size(), 0u);
  EXPECT_EQ(consequences(model, count - 4, "up").size(), 3u);
}

}  // namespace
}  // namespace toposcope
