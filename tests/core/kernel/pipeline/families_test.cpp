// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/kernel/pipeline/hand_made_run.h"
#include "pipeline/label.h"
#include "pipeline/relate.h"
#include "probability/number_costs.h"
#include "support/labeling_problems.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

/// Lists every labelling.
struct ListingLabeler final : Labeler {
  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request, Context&) const override {
    LabelingOutcome outcome;
    outcome.labelings = test::all_labelings(problem);
    const test::BruteForce sums = test::sums(problem, outcome.labelings);
    outcome.log_evidence = sums.log_evidence;
    outcome.posteriors = sums.posteriors;
    outcome.evidence_exactness = outcome.posterior_exactness = Exactness::exact;
    outcome.lower_bound = outcome.labelings.front().cost;
    outcome.labelings.resize(std::min(outcome.labelings.size(), request.k_best));
    outcome.optimal = true;
    outcome.guarantee = "all were listed";
    return outcome;
  }
};

/// A bar at row 0 or 9, and rods at rows 1, 3, 5, 8; of row 3 there is a part too. Rods lie within two rows of the bar,
/// if crisp.
struct FamilyLabelling : ::testing::Test, test::HandMadeRun {
  FamilyLabelling() {
    for (const int row : {0, 9, 1, 3, 5, 8}) add_set(row);
    add_set(3, 3);
    add_feature("bar", 1, nullptr);
    ModelFeature& rod = add_feature("rod", 1, nullptr);
    rod.count = {0, 3};
    rod.detectability = 0.9;
    model.features[0].detectability = 0.9;
    measure();
    features.of_feature.resize(2);
    for (const double row : {0, 9, 1, 3, 5, 8, 3}) {
      ConstructedFeature& made = features.all.emplace_back();
      made.sets = {static_cast<Index>(features.all.size() - 1)};
      made.shape.centroid = Vec3(0, row, 0);
    }
    features.of_feature[0] = {{0, 1}, {3, 2}, {1, 1}, {}};
    features.of_feature[1] = {{2, 3, 4, 5, 6}, {9, 8, 7, 6, 5}, {5, 5, 5, 5, 5}, {}};
    stations.labeler = {"lister", std::make_shared<ListingLabeler>()};
  }

  ClassOutcome solved() {
    const LabelingProblem problem = relate(run(), sets, features);
    return label_class(pose_classes(problem, model, stations.probability)[0], features, run(), {});
  }

  ConstructedFeatures features;
};

TEST_F(FamilyLabelling, AnInstanceCostsItsEvidenceAndNumbersTheRest) {
  const LabelingProblem problem = relate(run(), sets, features);
  EXPECT_EQ(problem.variables[1].costs[0], 0);
  EXPECT_NEAR(problem.variables[1].costs[1], std::log(5) - 9, 1e-12);
  const std::vector<Family> families = families_of(problem, run(), false);
  ASSERT_EQ(families.size(), 1U);
  EXPECT_EQ(families[0].variable, 1U);
  EXPECT_EQ(families[0].number_costs, number_costs({0, 3}, 0.9, 0, 5));
  EXPECT_EQ(families_of(problem, run(), true)[0].number_costs.size(), 6U);
}

TEST_F(FamilyLabelling, InstancesAreWrittenOutByTheirEvidence) {
  ClassOutcome written = solved();
  EXPECT_EQ(written.families[0].found, 3U);
  EXPECT_NEAR(written.families[0].numbers[3], 1, 0.05);
  const double best = written.outcome.labelings[0].cost;
  const Instances instances = write_out_instances(written, features, run());
  ASSERT_EQ(instances.model.features.size(), 4U);
  EXPECT_EQ(instances.model.features[1].name, "rod[1]");
  EXPECT_EQ(instances.model.features[3].name, "rod[3]");
  EXPECT_THAT(instances.origin, ElementsAre(0, 1, 1, 1));
  const Labeling& first = written.outcome.labelings[0];
  EXPECT_THAT(first.values, ElementsAre(1, 1, 1, 1));
  EXPECT_EQ(first.cost, best);
  EXPECT_EQ(written.problem.variables[1].candidates[0], 2U);
  EXPECT_THAT(written.problem.variables[2].candidates, ElementsAre(3, 6)) << "and what shares its vertices";
  for (const std::vector<double>& posterior : written.outcome.posteriors) {
    double sum = 0;
    for (const double each : posterior) sum += each;
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST_F(FamilyLabelling, ThereAreMoreThanTheModelAllows) {
  const ClassOutcome written = solved();
  ASSERT_TRUE(written.families[0].beyond);
  EXPECT_GT(written.families[0].beyond->first, 0.9);
  EXPECT_EQ(written.families[0].beyond->second, 4U) << "two of the five share vertices";
  model.features[1].count.most.reset();
  EXPECT_FALSE(solved().families[0].beyond);
}

TEST_F(FamilyLabelling, WhatMustBeThereAndIsNotIsAMissingInstance) {
  model.features[1].count = {6, 8};
  ClassOutcome written = solved();
  EXPECT_EQ(written.families[0].found, 4U);
  const Instances instances = write_out_instances(written, features, run());
  ASSERT_EQ(instances.model.features.size(), 7U);
  EXPECT_THAT(written.outcome.labelings[0].values, ElementsAre(1, 1, 1, 1, 1, 0, 0));
  EXPECT_NEAR(written.outcome.posteriors[6][0], 1, 1e-12);
}

/// Each rod apart from the bar, and pairs of rods apart from each other.
TEST_F(FamilyLabelling, RelationshipsHoldForEachInstanceAndForEachPair) {
  const auto tester = std::make_shared<test::ApartTester>();
  add_relationship(1, 0, tester);
  add_relationship(1, 1, tester);
  stations.probability.crisp = true;
  features.of_feature[0].evidence = {1, 1};  // rods at rows 1 and 3 without a bar are worth more than one and a bar
  ClassOutcome written = solved();
  EXPECT_EQ(written.families[0].found, 2U) << "of three rods two lie farther apart";
  const Instances instances = write_out_instances(written, features, run());
  std::vector<std::string> names;
  for (const Relationship& each : instances.model.relationships) names.push_back(each.name);
  ASSERT_THAT(names, ElementsAre("r1[1]", "r1[2]", "r2[1,2]"));
  EXPECT_THAT(instances.model.relationships[2].features, ElementsAre(1, 2));
  EXPECT_EQ(instances.stations.relationships.size(), 3U);
  for (const LabelingConstraint& constraint : written.problem.constraints)
    EXPECT_TRUE(satisfied(constraint, table_entry(written.problem, constraint, written.outcome.labelings[0].values)));
}

}  // namespace
}  // namespace toposcope
