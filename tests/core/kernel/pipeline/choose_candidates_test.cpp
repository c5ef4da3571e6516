// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/choose_candidates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/kernel/pipeline/hand_made_run.h"

namespace toposcope {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using enum GroupStatus;
using Sets = std::vector<Index>;

/// Fits without error, whose evidence is what they explain.
struct ChooseCandidates : ::testing::Test, test::HandMadeRun {
  ChooseCandidates() {
    add_feature("rod", 1, fitter).second_look = {"convex"};
    add_feature("bar", 1, fitter);
    features.of_feature.resize(2);
    for (ModelFeature& feature : model.features)
      feature.ranges = {{"length", expression("3"), expression("bb(O).a/2"), {}}};
  }

  WorkingSetGroups groups() {
    measure();
    return {model.features[0], model.features[0].worksets, sets};
  }

  /// \param status  per feature of the job, per group
  GroupFits fits(WorkingSetGroups of, const std::vector<double>& evidence,
                 const std::vector<std::vector<GroupStatus>>& status) const {
    GroupFits fits{std::move(of)};
    for (const std::vector<GroupStatus>& of_feature : status) {
      std::vector<GroupVerdict>& verdicts = fits.verdicts.emplace_back();
      for (const GroupStatus each : of_feature) verdicts.push_back({each});
    }
    fits.boxes.resize(evidence.size());
    for (std::size_t g = 0; g < evidence.size(); ++g) {
      FittedShape& shape = fits.shapes.emplace_back();
      shape.rms = 0;
      shape.explained = evidence[g];
      for (const Index v : sets[fits.groups[g][0]]) shape.outline.push_back(mesh.view().positions[v]);
      shape.centroid = shape.outline.front();
    }
    return fits;
  }

  std::vector<Sets> candidates(Index feature) const {
    std::vector<Sets> all;
    for (const Index c : features.of_feature[feature].constructed) all.push_back(features.all[c].sets);
    return all;
  }
  void choose(const FitJob& job, const GroupFits& of) { choose_candidates(job, of, run(), sets, features); }

  std::shared_ptr<test::MeanFitter> fitter = std::make_shared<test::MeanFitter>();
  ConstructedFeatures features;
};

TEST_F(ChooseCandidates, TheBestStayAndTheRestIsCounted) {
  for (int row = 0; row < 8; row += 1) add_set(row);
  stations.probability.max_candidates = 2;
  choose({{0}}, fits(groups(), {5, 9, 7, 20, 20, 20, 20, 20},
                     {{fitted, fitted, fitted, boxed_out, unusable, out_of_range, poor_fit, poor_fit}}));
  const FeatureCandidates& rod = features.of_feature[0];
  EXPECT_THAT(candidates(0), ElementsAre(Sets{1}, Sets{2}));
  EXPECT_THAT(rod.evidence, ElementsAre(DoubleNear(9, 1e-12), DoubleNear(7, 1e-12)));
  EXPECT_THAT(rod.ways, ElementsAre(3, 3)) << "three were fitted";
  EXPECT_EQ(rod.count.groups, 8U);
  EXPECT_EQ(rod.count.boxed_out, 1U);
  EXPECT_EQ(rod.count.unusable, 1U);
  EXPECT_EQ(rod.count.out_of_range, 1U);
  EXPECT_EQ(rod.count.poor_fit, 2U);
  EXPECT_EQ(rod.count.beaten, 1U);
  EXPECT_EQ(rod.count.kept, 2U);
}

TEST_F(ChooseCandidates, EachBoundSaysWhatItCostAndWhatCameNearest) {
  for (int row = 0; row < 5; ++row) add_set(row);
  GroupFits all = fits(groups(), {5, 9, 7, 3, 2}, {{fitted, out_of_range, out_of_range, boxed_out, out_of_range}});
  all.verdicts[0][1] = {out_of_range, 1, 9, 4.5};
  all.verdicts[0][2] = {out_of_range, 1, 5, 4.5};
  all.verdicts[0][3] = {boxed_out, 0, 2, 3};
  all.verdicts[0][4] = {out_of_range, 1, 7, 4.5};
  choose({{0}}, all);
  const std::vector<BoundCount>& bounds = features.of_feature[0].count.bounds;
  ASSERT_EQ(bounds.size(), 2U);
  EXPECT_EQ(bounds[0].words, "3 < length");
  EXPECT_EQ(bounds[0].groups, 1U);
  EXPECT_EQ(bounds[0].nearest, 2);
  EXPECT_EQ(bounds[1].words, "length < bb(O).a/2");
  EXPECT_EQ(bounds[1].groups, 3U);
  EXPECT_EQ(bounds[1].nearest, 5);
  EXPECT_EQ(bounds[1].limit, 4.5);
}

TEST_F(ChooseCandidates, OfEqualEvidenceTheFirstStays) {
  for (int row = 0; row < 3; ++row) add_set(row);
  stations.probability.max_candidates = 1;
  choose({{0}}, fits(groups(), {4, 4, 4}, {{poor_fit, fitted, fitted}}));
  EXPECT_THAT(candidates(0), ElementsAre(Sets{1}));
}

TEST_F(ChooseCandidates, AnErrorOfTheModelsLimitCountsAgainstAFit) {
  add_set(0);
  model.features[0].max_fit_error = expression("bb(O).a/9");  // one: a typical error is half of it
  GroupFits all = fits(groups(), {8}, {{fitted}});
  all.shapes[0].rms = 0.5;
  choose({{0}}, all);
  EXPECT_NEAR(features.of_feature[0].evidence[0], 8 * (1 - 0.5), 1e-9);
  model.features[0].max_fit_error.reset();
  features.of_feature[0] = {};
  choose({{0}}, all);
  const double x = 0.5 / mesh.view().mean_edge;
  EXPECT_NEAR(features.of_feature[0].evidence[0], 8 * (1 - x * x / 2), 1e-9) << "the pipeline's typical error";
}

TEST_F(ChooseCandidates, AGroupIsConstructedOnceForAllFeaturesThatKeepIt) {
  for (int row = 0; row < 3; ++row) add_set(row);
  choose({{0, 1}}, fits(groups(), {5, 9, 7}, {{fitted, fitted, boxed_out}, {boxed_out, fitted, fitted}}));
  EXPECT_THAT(candidates(0), ElementsAre(Sets{1}, Sets{0}));
  EXPECT_THAT(candidates(1), ElementsAre(Sets{1}, Sets{2}));
  EXPECT_EQ(features.all.size(), 3U);
  EXPECT_EQ(features.of_feature[0].constructed[0], features.of_feature[1].constructed[0]);
  EXPECT_EQ(features.all[0].points.size(), 5U);
}

/// Two of four groups were tried: as many of the others would have passed.
TEST_F(ChooseCandidates, ThoseNotTriedCountAsThoseThatWere) {
  for (int row = 0; row < 4; ++row) add_set(2 * row);
  WorkingSetGroups some = groups();
  some.keep({1, 3});
  choose({{0}, true}, fits(some, {6, 8}, {{fitted, poor_fit}}));
  EXPECT_THAT(features.of_feature[0].ways, ElementsAre(2)) << "one of two of four";
}

TEST_F(ChooseCandidates, OldCandidatesKeepThePriceOfTheirOwnLook) {
  add_set(0);
  add_set(4);
  features.all.resize(1);
  features.all[0].sets = {1};
  features.all[0].shape.outline = {Vec3(0, -0.5, 0)};
  features.all[0].shape.centroid = Vec3(0, -0.5, 0);
  FeatureCandidates& rod = features.of_feature[0];
  rod.constructed = {0};
  rod.evidence = {7};
  rod.ways = {10};
  choose({{0}, true}, fits(groups(), {6, 1}, {{fitted, poor_fit}}));
  // 7 - log 10 is less than 6 - log 1.
  EXPECT_THAT(candidates(0), ElementsAre(Sets{0}, Sets{1}));
  EXPECT_THAT(rod.ways, ElementsAre(1, 10));
  EXPECT_THAT(rod.evidence, ElementsAre(DoubleNear(6, 1e-12), DoubleNear(7, 1e-12)));
}

/// Sets 0 and 1 share vertices and their shapes are the same, set 2 lies elsewhere.
TEST_F(ChooseCandidates, OverlappingGroupsOfOneShapeAreOneChoiceInASecondLook) {
  add_set(0);
  add_set(0, 4);
  add_set(5);
  const GroupFits all = fits(groups(), {9, 8, 7}, {{fitted, fitted, fitted}});
  choose({{0}, true}, all);
  const FeatureCandidates& rod = features.of_feature[0];
  EXPECT_THAT(candidates(0), ElementsAre(Sets{0}, Sets{2}));
  EXPECT_THAT(rod.evidence, ElementsAre(DoubleNear(std::log(std::exp(9) + std::exp(8)), 1e-9), DoubleNear(7, 1e-12)))
      << "the sum of their likelihoods";
  EXPECT_EQ(rod.count.beaten, 1U);
  features.of_feature[0] = {};
  choose({{0}}, all);
  EXPECT_THAT(candidates(0), ElementsAre(Sets{0}, Sets{1}, Sets{2})) << "in a first look they are three";
}

TEST_F(ChooseCandidates, OverlappingGroupsOfTwoShapesAreTwoChoices) {
  add_set(0);
  add_set(0, 4);
  GroupFits all = fits(groups(), {9, 8}, {{fitted, fitted}});
  all.shapes[1].centroid.y() += 2;  // beyond a mean edge
  choose({{0}, true}, all);
  EXPECT_THAT(candidates(0), ElementsAre(Sets{0}, Sets{1}));
}

}  // namespace
}  // namespace toposcope
