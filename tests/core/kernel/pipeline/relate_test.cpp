// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/relate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/run_context.h"
#include "core/kernel/pipeline/hand_made_run.h"
#include "probability/likelihood.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr float never = std::numeric_limits<float>::infinity();

/// Bar and rod may each be one of the rows 0, 1 and 4. The tolerance of their relationship is two rows.
struct Relate : ::testing::Test, test::HandMadeRun {
  Relate() {
    for (const int row : {0, 1, 4}) add_set(row);
    for (const char* name : {"bar", "rod"}) add_feature(name, 1, nullptr);
    add_relationship(0, 1, tester);
    measure();
    features.of_feature.resize(2);
    for (const double row : {0, 1, 4}) {
      ConstructedFeature& made = features.all.emplace_back();
      made.sets = {static_cast<Index>(features.all.size() - 1)};
      made.shape.centroid = Vec3(0, row, 0);
    }
    for (FeatureCandidates& candidates : features.of_feature) {
      candidates.constructed = {0, 1, 2};
      candidates.evidence = {3, 2, 1};
      candidates.ways = {4, 4, 4};
    }
  }
  LabelingProblem problem(const LabelingProblem* known = nullptr) const { return relate(run(), sets, features, known); }

  std::shared_ptr<test::ApartTester> tester = std::make_shared<test::ApartTester>();
  ConstructedFeatures features;
};

TEST_F(Relate, ACandidatesCostIsThatOfItsFeatureAndItsChoiceLessItsEvidence) {
  model.features[0].detectability = 0.75;
  const LabelingVariable bar = problem().variables[0];
  EXPECT_EQ(bar.name, "bar");
  EXPECT_THAT(bar.candidates, ElementsAre(0, 1, 2));
  const double present = -std::log(0.75) + std::log(4);
  EXPECT_THAT(bar.costs, ElementsAre(DoubleNear(-std::log(0.25), 1e-12), DoubleNear(present - 3, 1e-12),
                                     DoubleNear(present - 2, 1e-12), DoubleNear(present - 1, 1e-12)));
}

TEST_F(Relate, CandidatesThatShareAVertexExclude) {
  features.all[2].sets = {0, 2};
  const LabelingProblem made = problem();
  ASSERT_EQ(made.candidate_count, 3U);
  EXPECT_TRUE(made.conflict(0, 2) && made.conflict(2, 0) && made.conflict(1, 1));
  EXPECT_FALSE(made.conflict(0, 1) || made.conflict(1, 2));
}

TEST_F(Relate, EveryEntryByHand) {
  const LabelingConstraint table = problem().constraints[0];
  EXPECT_EQ(table.name, "r1");
  EXPECT_THAT(table.scope, ElementsAre(0, 1));
  // Rows and columns: missing, rows 0, 1 and 4. A candidate excludes itself.
  EXPECT_THAT(table.violations, ElementsAre(0, 0, 0, 0,            //
                                            0, never, 0.5F, 2,     //
                                            0, 0.5F, never, 1.5F,  //
                                            0, 2, 1.5F, never));
  RelationResult apart;
  apart.tolerance = 2;
  apart.clutter_density = 0.125;
  apart.residual = 3;
  EXPECT_EQ(table.costs[2 * 4 + 3], -relation_evidence(stations.probability, apart));
  EXPECT_EQ(table.costs[3 * 4 + 2], table.costs[2 * 4 + 3]);
  EXPECT_EQ(table.costs[1 * 4 + 1], forbidden);
  EXPECT_EQ(table.costs[1], 0);
  EXPECT_EQ(tester->tests, 3) << "their order does not matter: each pair once";
}

TEST_F(Relate, EachPairIsTestedBothWaysWhereTheOrderMatters) {
  stations.relationships[0].ordered = true;
  problem();
  EXPECT_EQ(tester->tests, 6);
}

TEST_F(Relate, ACrispRelationshipForbidsWhatIsBeyondItsTolerance) {
  stations.probability.crisp = true;
  const LabelingConstraint table = problem().constraints[0];
  EXPECT_EQ(table.costs[2 * 4 + 3], forbidden);
  EXPECT_LT(table.costs[1 * 4 + 2], forbidden);
}

TEST_F(Relate, OneTableServesAllThatAskTheSame) {
  add_relationship(1, 0, tester);
  const LabelingProblem made = problem();
  EXPECT_EQ(tester->tests, 3);
  EXPECT_EQ(made.constraints[1].name, "r2");
  EXPECT_THAT(made.constraints[1].scope, ElementsAre(1, 0));
  EXPECT_EQ(made.constraints[1].costs, made.constraints[0].costs);
  model.relationships[1].tolerance = expression("bb(O).a/3");
  EXPECT_NEAR(problem().constraints[1].violations[1 * 4 + 3], 4.0 / 3, 1e-6) << "another tolerance is another table";
  EXPECT_EQ(tester->tests, 3 + 6);
}

TEST_F(Relate, WhatIsKnownIsNotTestedAgain) {
  const LabelingProblem first = problem();
  EXPECT_EQ(problem(&first).constraints[0].costs, first.constraints[0].costs);
  EXPECT_EQ(tester->tests, 3);
  features.of_feature[1].constructed.pop_back();
  features.of_feature[1].evidence.pop_back();
  EXPECT_EQ(problem(&first).constraints[0].costs.size(), 12U);
  EXPECT_EQ(tester->tests, 3 + 4) << "three rows for the bar and two for the rod, less two that exclude themselves";
}

/// The least labelling, and the cost of the least one without the rod.
struct Least {
  std::vector<Index> values;
  double cost = forbidden, without_rod = forbidden;
};
Least brute_force(const LabelingProblem& problem) {
  Least least;
  for (Index bar = 0; bar < problem.variables[0].domain(); ++bar)
    for (Index rod = 0; rod < problem.variables[1].domain(); ++rod) {
      const std::vector<Index> values = {bar, rod};
      const double cost = cost_of(problem, values);
      if (rod == 0) least.without_rod = std::min(least.without_rod, cost);
      if (cost < least.cost) least.cost = cost, least.values = values;
    }
  return least;
}

/// The bar fits best at row 4, too far from the rod at row 1.
TEST_F(Relate, ARequiredFeatureIsNotLeftOutToEscapeItsRelationship) {
  stations.probability.crisp = true;
  features.of_feature[0].evidence = {2, 1, 7};
  features.of_feature[1] = {{1}, {1}, {1}, {}};
  features.of_feature[0].ways = {1, 1, 1};
  for (ModelFeature& feature : model.features) feature.detectability = 0.9;
  const LabelingProblem optional = problem();
  const Least dodged = brute_force(optional);
  EXPECT_THAT(dodged.values, ElementsAre(3, 0));

  model.features[1].count = {1, 1};
  const LabelingProblem required = problem();
  const Least kept = brute_force(required);
  EXPECT_THAT(kept.values, ElementsAre(1, 1));
  RelationResult apart;
  apart.tolerance = 2;
  apart.clutter_density = 0.125;
  apart.residual = 1;
  const double worth = 1 + std::log(0.9) + 0.9 * relation_evidence(stations.probability, apart);
  EXPECT_NEAR(kept.without_rod - dodged.without_rod, worth, 1e-12);
  EXPECT_EQ(required.variables[1].costs[1], optional.variables[1].costs[1]) << "a labelling that has it pays nothing";
}

TEST_F(Relate, ARequiredFeatureWithoutCandidatesPaysNothing) {
  features.of_feature[1] = {};
  const double optional = problem().variables[1].costs[0];
  model.features[1].count = {1, 1};
  EXPECT_EQ(problem().variables[1].costs[0], optional);
}

/// Sixteen entries of a cost and a violation.
TEST_F(Relate, TablesBeyondTheRunsMemoryAreRefused) {
  const auto related = [&](std::uint64_t bytes) {
    RunContext context({.memory_budget = bytes});
    return relate({mesh.view(), model, stations, context}, sets, features);
  };
  EXPECT_NO_THROW(related(16 * 12));
  try {
    related(16 * 12 - 1);
    FAIL() << "a byte too many";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(HasSubstr("'r1'"), HasSubstr("192"), HasSubstr("191")));
  }
  add_relationship(1, 0, tester);
  EXPECT_THROW(related(2 * 16 * 12 - 1), UsageError) << "a table that is copied takes memory too";
}

TEST_F(Relate, ATableThatIsTooLargeIsRefused) {
  for (FeatureCandidates& candidates : features.of_feature) {
    candidates.constructed.assign(5000, 0);
    candidates.evidence.assign(5000, 0);
    candidates.ways.assign(5000, 1);
  }
  try {
    problem();
    FAIL() << "25 million entries";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(HasSubstr("'r1'"), HasSubstr("max_candidates")));
  }
}

}  // namespace
}  // namespace toposcope
