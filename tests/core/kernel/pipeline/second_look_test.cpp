// SPDX-License-Identifier: BSD-3-Clause

// A second look fits the groups that a feature names for it, of what no other feature has taken, and loses nothing of
// the first.

#include "pipeline/second_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/kernel/pipeline/rows_of_a_grid.h"
#include "pipeline/bound_relation.h"
#include "pipeline/relate.h"
#include "probability/likelihood.h"

namespace toposcope {
namespace {

using ::testing::ElementsAre;

constexpr const char* three_features = R"(
schema: toposcope.model/1
name: frame
features:
  bar: {worksets: [convex], shape: lgrp1}
  pair: {worksets: [convex], second_look: [convex, convex], shape: lgrp3}
  rod: {worksets: [convex], shape: lgrp1}
relationships:
  r1: {features: [bar, rod], type: parallel}
  r2: {features: [bar, pair], type: parallel}
)";

/// Set 0 is the first row, set 1 the first two, sets 2 and 3 the rows 8 and 12.
struct SecondLook : ::testing::Test, test::Rows {
  SecondLook() : Rows(three_features, 20) {
    add_rows(0, 0);
    add_rows(0, 1);
    add_rows(8, 8);
    add_rows(12, 12);
    first_look();
  }
};

TEST_F(SecondLook, AddsTheGroupsThatAFeatureNamesForIt) {
  const std::set<std::vector<Index>> first = groups_of(1);
  EXPECT_THAT(first,
              ElementsAre(std::vector<Index>{0}, std::vector<Index>{1}, std::vector<Index>{2}, std::vector<Index>{3}));
  EXPECT_TRUE(look({{}, {}}));
  using Group = std::vector<Index>;
  // Sets 0 and 1 lie in the same place, half an edge apart: with another they are one choice.
  EXPECT_THAT(groups_of(1), ElementsAre(Group{0}, Group{0, 2}, Group{0, 3}, Group{1}, Group{2}, Group{2, 3}, Group{3}));
  EXPECT_EQ(groups_of(0), first);  // it names none
  const FeatureCandidates& pair = features.of_feature[1];
  EXPECT_EQ(pair.count.groups, 9u);
  EXPECT_EQ(pair.count.kept, pair.constructed.size());
  // Of five pairs a candidate is one of five, of four single sets one of four.
  std::vector<double> cost;
  for (std::size_t c = 0; c < pair.constructed.size(); ++c) {
    const bool single = features.all[pair.constructed[c]].sets.size() == 1;
    EXPECT_EQ(pair.ways[c], single ? 4 : 5);
    cost.push_back(std::log(pair.ways[c]) - pair.evidence[c]);
  }
  EXPECT_TRUE(std::is_sorted(cost.begin(), cost.end()));
}

TEST_F(SecondLook, AChoiceSeenAtSeveralLevelsHasTheLikelihoodOfThemAll) {
  const auto evidence_of = [&](const std::vector<Index>& group) {
    const FeatureCandidates& pair = features.of_feature[1];
    for (std::size_t c = 0; c < pair.constructed.size(); ++c)
      if (features.all[pair.constructed[c]].sets == group) return pair.evidence[c];
    return std::numeric_limits<double>::quiet_NaN();
  };
  ASSERT_TRUE(look({}));
  const double joined = evidence_of({0, 2});
  const auto alone = [&](const std::vector<Index>& group) {
    const FittedShape& shape = features.all[candidate(1, group)].shape;
    return fit_evidence(stations.probability, shape, stations.probability.fit_error_scale * mesh.view().mean_edge);
  };
  // Sets 2 and 3 have no likes.
  EXPECT_NEAR(evidence_of({2, 3}), alone({2, 3}), 1e-9);
  EXPECT_GT(joined, alone({0, 2}) + 1e-3);
  EXPECT_LE(joined, alone({0, 2}) + std::log(2.0) + 1e-9) << "the best stands for two, the other is no better";
}

TEST_F(SecondLook, LeavesAloneWhatAnotherFeatureHasTaken) {
  EXPECT_TRUE(look({candidate(0, {0}), candidate(1, {2})}));
  // Set 1 shares vertices with set 0, which is the bar's; set 2 is the pair's own.
  using Group = std::vector<Index>;
  EXPECT_THAT(groups_of(1), ElementsAre(Group{0}, Group{1}, Group{2}, Group{2, 3}, Group{3}));
}

TEST_F(SecondLook, SaysWhereItFindsNothingNew) {
  model.features[1].second_look = {"concave", "concave"};  // the mesh has none
  EXPECT_FALSE(look({{}, {}}));
  EXPECT_EQ(features.of_feature[1].count.groups, 4u);
}

TEST_F(SecondLook, TheProblemIsTheSameWhetherOrNotTheFirstIsKnown) {
  const auto problem = [&](const LabelingProblem* known) { return relate(run(), sets, features, known); };
  const LabelingProblem first = problem(nullptr);
  ASSERT_TRUE(look({}));
  const LabelingProblem afresh = problem(nullptr), known = problem(&first);
  EXPECT_NE(afresh.constraints[1].costs.size(), first.constraints[1].costs.size());
  ASSERT_EQ(known.constraints.size(), afresh.constraints.size());
  for (std::size_t r = 0; r < afresh.constraints.size(); ++r) {
    EXPECT_EQ(known.constraints[r].costs, afresh.constraints[r].costs) << r;
    EXPECT_EQ(known.constraints[r].violations, afresh.constraints[r].violations) << r;
  }
}

/// Bar and rod have the same candidates, so that each pair of them is tested once and serves both ways round.
TEST_F(SecondLook, EveryEntryOfATableIsWhatItsRelationshipSays) {
  const LabelingProblem problem = relate(run(), sets, features);
  ASSERT_EQ(problem.variables[0].candidates, problem.variables[2].candidates);
  std::size_t tested = 0;
  for (Index r = 0; r < problem.constraints.size(); ++r) {
    const LabelingConstraint& constraint = problem.constraints[r];
    EXPECT_EQ(constraint.scope, model.relationships[r].features);
    const LabelingVariable &first = problem.variables[constraint.scope[0]],
                           &second = problem.variables[constraint.scope[1]];
    for (std::size_t i = 1; i < first.domain(); ++i)
      for (std::size_t j = 1; j < second.domain(); ++j) {
        const Index a = first.candidates[i - 1], b = second.candidates[j - 1];
        const float found = constraint.violations[i * second.domain() + j];
        if (problem.conflict(a, b)) {
          EXPECT_EQ(found, std::numeric_limits<float>::infinity());
          continue;
        }
        const ConstructedFeature* const given[] = {&features.all[a], &features.all[b]};
        const RelationResult result = test_relationship(run(), r, given);
        EXPECT_NEAR(found, violation(result), 1e-6) << r << ": " << i << ", " << j;
        ++tested;
      }
  }
  EXPECT_GT(tested, 4u);
}

/// Two parallel edges four apart, as those of a fin under a T-tail: the lines run along both, and one joins them.
TEST_F(SecondLook, TwoEdgesThatDoNotMeetMakeOneLineGroup) {
  ASSERT_TRUE(look({{}, {}}));
  const FittedShape& shape = features.all[candidate(1, {2, 3})].shape;
  const auto& fitter = stations.features[1].fitter;
  for (const Index row : {2, 3})
    for (const Index v : sets[row]) EXPECT_LT(fitter->distance(shape, mesh.view().positions[v]), 0.3) << v;
  EXPECT_NEAR(shape.measure("length_2")->value, 4, 0.5);
}

/// Of groups that were chosen from many, those that were not tried would pass as often as those that were.
TEST_F(SecondLook, AChoicePaysForTheGroupsThatItWasChosenFrom) {
  WorkingSetGroups groups(model.features[1], model.features[1].second_look, sets);
  ASSERT_EQ(groups.size(), 5u);
  groups.keep({2, 4});
  ASSERT_EQ(groups.size(), 2u);
  construct_more(run(), sets, 1, groups, features);
  const FeatureCandidates& pair = features.of_feature[1];
  std::size_t pairs = 0;
  for (std::size_t c = 0; c < pair.constructed.size(); ++c)
    if (features.all[pair.constructed[c]].sets.size() == 2) {
      EXPECT_EQ(pair.ways[c], 5) << "both passed: all five would";
      ++pairs;
    }
  EXPECT_EQ(pairs, 2u);
}

constexpr const char* near_each_other = R"(
schema: toposcope.model/1
name: neighbours
features:
  bar: {worksets: [convex], shape: lgrp1}
  pair: {worksets: [convex], second_look: [convex, convex], shape: lgrp3}
relationships:
  r1: {features: [bar, pair], type: centroid-distance, min: 0, max: bb(O).a/40, tolerance: 3*bb(O).a}
)";

/// More pairs than are fitted: those that the relationships with what is labelled favour come first, however salient
/// others are.
TEST(SecondLookAtMany, FitsThosePairsThatTheRelationshipsFavour) {
  test::Rows rows(near_each_other, 39);
  for (int row = 0; row < 40; ++row) {
    rows.add_rows(row, row);
    rows.sets.saliency.back() = 1 + row;
  }
  rows.first_look();
  ASSERT_TRUE(rows.look({rows.candidate(0, {0})}));
  EXPECT_EQ(rows.features.of_feature[1].count.groups, 40u + 500u) << "of 741 pairs without the bar's row";
  EXPECT_THAT(rows.groups_of(1), ::testing::Contains(std::vector<Index>{1, 11})) << "not salient, but near the bar";
}

}  // namespace
}  // namespace toposcope
