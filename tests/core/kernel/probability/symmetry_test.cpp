// SPDX-License-Identifier: BSD-3-Clause
#include "probability/symmetry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace toposcope {
namespace {

using ::testing::ElementsAre;
using Renaming = std::vector<Index>;

/// A model of features that are alike until a test tells them apart, and the question after all of it.
struct Symmetry : ::testing::Test {
  void add_features(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      features.push_back(static_cast<Index>(model.features.size()));
      ModelFeature& feature = model.features.emplace_back();
      feature.name = std::string(1, static_cast<char>('a' + i));
      feature.shape.plugin = "circle";
      feature.worksets = {"convex"};
    }
  }
  Relationship& relate(const std::string& plugin, std::vector<Index> scope, bool is_ordered = false) {
    relationships.push_back(static_cast<Index>(model.relationships.size()));
    ordered.push_back(is_ordered);
    Relationship& relationship = model.relationships.emplace_back();
    relationship.plugin = plugin;
    relationship.features = std::move(scope);
    return relationship;
  }
  std::vector<Renaming> all(bool by_detectability = true) const {
    return renamings({model, features, relationships, ordered, by_detectability});
  }

  Model model;
  std::vector<Index> features, relationships;
  std::vector<bool> ordered;
};

TEST_F(Symmetry, TwoAlikeChangeNamesWhereTheirOrderDoesNotMatter) {
  add_features(2);
  relate("parallel", {0, 1});
  EXPECT_THAT(all(), ElementsAre(Renaming{0, 1}, Renaming{1, 0}));
}

TEST_F(Symmetry, ADirectionTellsThemApart) {
  add_features(2);
  relate("above", {0, 1}, true);
  EXPECT_THAT(all(), ElementsAre(Renaming{0, 1}));
}

TEST_F(Symmetry, WhatAFeatureAsksForTellsItApart) {
  add_features(2);
  const auto expect_alone = [&](const char* why) { EXPECT_THAT(all(), ElementsAre(Renaming{0, 1})) << why; };
  const ModelFeature alike = model.features[1];
  ModelFeature& other = model.features[1];
  other.shape.plugin = "plane";
  expect_alone("shape");
  (other = alike).shape.arguments = {{"segments", "3"}};
  expect_alone("argument");
  (other = alike).worksets = {"concave"};
  expect_alone("working sets");
  (other = alike).second_look = {"convex"};
  expect_alone("second look");
  (other = alike).max_fit_error = Expression::parse("bb(O).a/9", {"by hand", 1, 1});
  expect_alone("fit error");
  (other = alike).ranges = {{"radius", Expression::parse("bb(O).a/9", {"by hand", 1, 1}), {}, {}}};
  expect_alone("range");
  other = alike;
  EXPECT_EQ(all().size(), 2U);
}

TEST_F(Symmetry, DetectabilityTellsApartWhereItCounts) {
  add_features(2);
  model.features[0].detectability = 0.75;
  EXPECT_THAT(all(true), ElementsAre(Renaming{0, 1}));
  EXPECT_THAT(all(false), ElementsAre(Renaming{0, 1}, Renaming{1, 0}));
}

/// Wings and stabilisers of an airplane: the sides change together or not at all.
TEST_F(Symmetry, PairsThatAreTiedChangeTogether) {
  add_features(4);
  relate("wings", {0, 1});
  relate("stabilisers", {2, 3});
  relate("same-side", {0, 2});
  relate("same-side", {1, 3});
  const auto found = all();
  EXPECT_THAT(found, ElementsAre(Renaming{0, 1, 2, 3}, Renaming{1, 0, 3, 2}));
  EXPECT_THAT(orbits_of(found), ElementsAre(Renaming{0, 1}, Renaming{0, 1}, Renaming{2, 3}, Renaming{2, 3}));
}

TEST_F(Symmetry, AToleranceOfItsOwnTellsARelationshipApart) {
  add_features(3);
  relate("parallel", {0, 1});
  relate("parallel", {1, 2});
  EXPECT_THAT(all(), ElementsAre(Renaming{0, 1, 2}, Renaming{2, 1, 0}));
  model.relationships[1].tolerance = Expression::parse("5", {"by hand", 1, 1});
  EXPECT_THAT(all(), ElementsAre(Renaming{0, 1, 2}));
}

/// Renamings count positions in the question and not the model's features.
TEST_F(Symmetry, AQuestionOfSomeFeatures) {
  add_features(5);
  relate("above", {0, 2}, true);
  relate("parallel", {2, 4});
  features = {2, 4};
  relationships = {1};
  EXPECT_THAT(all(), ElementsAre(Renaming{0, 1}, Renaming{1, 0}));
}

TEST_F(Symmetry, MoreThanFiftyThousandAreNotTried) {
  add_features(8);
  EXPECT_EQ(all().size(), 40'320U);
  add_features(1);
  EXPECT_THAT(all(), ElementsAre(Renaming{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Orbits, OfTheIdentityAreSingle) {
  EXPECT_THAT(orbits_of({{0, 1, 2}}), ElementsAre(Renaming{0}, Renaming{1}, Renaming{2}));
}

/// Three in a ring: each reaches all.
TEST(Orbits, ReachAsFarAsAnyRenaming) {
  EXPECT_THAT(orbits_of({{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}),
              ElementsAre(Renaming{0, 1, 2}, Renaming{0, 1, 2}, Renaming{0, 1, 2}));
}

}  // namespace
}  // namespace toposcope
