// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/classes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/labeling_problems.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Rim, handle and spout; r1 relates rim and spout, r2 rim and handle, r3 handle and spout.
struct Classes : ::testing::Test {
  Classes() {
    model.name = "vessel";
    problem.name = "vessel";
    problem.candidate_count = 3;
    for (Index c = 0; c < 3; ++c) set_conflict(problem, c, c);
    for (const char* name : {"rim", "handle", "spout"}) {
      model.features.emplace_back().name = name;
      const Index candidate = static_cast<Index>(problem.variables.size());
      problem.variables.push_back(
          {.name = name, .detectability = 0.5, .candidates = {candidate}, .costs = {std::log(2), std::log(2) - 3}});
    }
    for (const std::vector<Index>& scope : {std::vector<Index>{0, 2}, {0, 1}, {1, 2}}) {
      Relationship& relationship = model.relationships.emplace_back();
      relationship.features = scope;
      relationship.plugin = "parallel";
      LabelingConstraint& constraint = problem.constraints.emplace_back(empty_constraint(problem, scope));
      constraint.name = relationship.name = "r" + std::to_string(model.relationships.size());
    }
    stations.relationships.resize(3);
    stations.probability.certainty = 0.9;
  }
  std::vector<ClassOutcome> posed() const { return pose_classes(problem, model, stations.probability); }

  Model model;
  LabelingProblem problem;
  Stations stations;
};

TEST_F(Classes, WithoutRulesTheWholeModelIsOne) {
  const auto whole = posed();
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].name, "vessel");
  EXPECT_THAT(whole[0].features, ElementsAre(0, 1, 2));
  EXPECT_THAT(whole[0].relationships, ElementsAre(0, 1, 2));
  EXPECT_EQ(whole[0].problem.variables[0].costs, problem.variables[0].costs);
}

TEST_F(Classes, ARuleHasTheFeaturesThatItsRelationshipsName) {
  model.classes = {{"jug", {2}, {}}, {"pot", {0, 1}, {}}};
  const auto rules = posed();
  ASSERT_EQ(rules.size(), 2U);
  const ClassOutcome& jug = rules[0];
  EXPECT_EQ(jug.name, "jug");
  EXPECT_EQ(jug.problem.name, "jug");
  EXPECT_THAT(jug.features, ElementsAre(1, 2));
  EXPECT_THAT(jug.relationships, ElementsAre(2));
  ASSERT_EQ(jug.problem.variables.size(), 2U);
  EXPECT_EQ(jug.problem.variables[0].name, "handle");
  EXPECT_THAT(jug.problem.variables[1].candidates, ElementsAre(2));
  ASSERT_EQ(jug.problem.constraints.size(), 1U);
  EXPECT_EQ(jug.problem.constraints[0].name, "r3");
  EXPECT_THAT(jug.problem.constraints[0].scope, ElementsAre(0, 1)) << "handle and spout, as the class counts them";
  EXPECT_NO_THROW(check(jug.problem));
  EXPECT_THAT(rules[1].features, ElementsAre(0, 1, 2));
}

TEST_F(Classes, AFeatureThatAClassNamesBelongsToIt) {
  model.classes = {{"jug", {2}, {}}};
  const LabelingVariable handle = posed()[0].problem.variables[0];
  EXPECT_EQ(handle.detectability, 1);
  // Certainty 0.9 in the place of the detectability 0.5.
  EXPECT_THAT(handle.costs, ElementsAre(DoubleNear(-std::log(0.1), 1e-12), DoubleNear(-std::log(0.9) - 3, 1e-12)));
}

TEST_F(Classes, RenamingsAreOfTheClassAndKnowOrderedRelationships) {
  model.classes = {{"jug", {2}, {}}};
  const ClassOutcome jug = posed()[0];
  EXPECT_EQ(renamings_of(jug, model, stations).size(), 2U);
  model.features[1].detectability = 0.25;
  EXPECT_EQ(renamings_of(jug, model, stations).size(), 2U) << "detectability tells no features of a class apart";
  stations.relationships[2].ordered = true;
  EXPECT_EQ(renamings_of(jug, model, stations).size(), 1U);
}

TEST(ClassEvidence, IsTheEvidenceWhereAllHaveOne) {
  const auto evidence = comparable_evidence({{3, -10}, {-forbidden, 20}, {1, -30}});
  EXPECT_EQ(evidence, (std::vector<double>{3, -forbidden, 1}));
  const auto p = class_probabilities(evidence);
  const double sum = std::exp(3) + std::exp(1) + 1;
  ASSERT_EQ(p.size(), 4);
  EXPECT_NEAR(p[0], std::exp(3) / sum, 1e-15);
  EXPECT_EQ(p[1], 0);
  EXPECT_NEAR(p[3], 1 / sum, 1e-15);
}

TEST(ClassEvidence, IsTheBestLabellingsCostWhereOneHasNone) {
  EXPECT_EQ(comparable_evidence({{3, -10}, {none, 20}}), (std::vector<double>{10, -20}));
  EXPECT_EQ(comparable_evidence({{none, forbidden}}), (std::vector<double>{-forbidden}));
  EXPECT_EQ(class_probabilities({-forbidden}), (std::vector<double>{0, 1}));
  // Thousands of nats neither overflow nor vanish.
  EXPECT_EQ(class_probabilities({5000, 4000}), (std::vector<double>{1, 0, 0}));
}

}  // namespace
}  // namespace toposcope
