// SPDX-License-Identifier: BSD-3-Clause
// Marginals and evidence against brute force.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "posterior_fixture.h"
#include "support/labeler_checks.h"
#include "support/labeling_problems.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

void expect_exact(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& what) {
  SCOPED_TRACE(what);
  const std::vector<Labeling> all = test::all_labelings(problem);
  const test::BruteForce sums = test::sums(problem, all);
  EXPECT_EQ(outcome.evidence_exactness, Exactness::exact);
  EXPECT_EQ(outcome.posterior_exactness, all.empty() ? Exactness::none : Exactness::exact);
  if (all.empty()) {
    EXPECT_EQ(outcome.log_evidence, -forbidden);
    EXPECT_TRUE(outcome.posteriors.empty());
    EXPECT_EQ(outcome.labelings.size(), all_missing(problem).size());
    EXPECT_TRUE(outcome.optimal);
    EXPECT_EQ(outcome.lower_bound, forbidden);
    return;
  }
  EXPECT_NEAR(outcome.log_evidence, sums.log_evidence, 1e-9);
  test::expect_posteriors(outcome, sums.posteriors, 1e-9);
  EXPECT_TRUE(outcome.optimal);
  EXPECT_LE(outcome.lower_bound, all.front().cost);
  EXPECT_NEAR(outcome.lower_bound, all.front().cost, 1e-9);
  ASSERT_EQ(outcome.labelings.size(), std::min<std::size_t>(10, all.size()));
  for (std::size_t k = 0; k < outcome.labelings.size(); ++k) {
    EXPECT_EQ(outcome.labelings[k].values, all[k].values) << k;
    EXPECT_EQ(outcome.labelings[k].cost, all[k].cost) << k;
  }
}

class PosteriorMethods : public ::testing::TestWithParam<const char*> {};

TEST_P(PosteriorMethods, AreBruteForce) {
  int proven = 0, impossible = 0;
  for (std::uint64_t seed = 0; seed < 2000 && !HasFailure(); ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", GetParam()}});
    expect_exact(problem, outcome, "seed " + std::to_string(seed));
    EXPECT_EQ(outcome.guarantee.substr(0, 5), "exact") << outcome.guarantee;
    proven += test::fact(outcome, "method") == GetParam();
    impossible += outcome.labelings.empty();
  }
  EXPECT_GT(proven, std::string(GetParam()) == "auto" ? -1 : 1500);
  EXPECT_GT(impossible, 20);
}
INSTANTIATE_TEST_SUITE_P(All, PosteriorMethods, ::testing::Values("auto", "elimination", "search"));

// The cheap values lead nowhere: the bound lies 2,000 nats below the only labellings there are.
TEST(Posterior, BoundFarBelowTheEvidence) {
  LabelingProblem problem;
  for (int i = 0; i < 3; ++i) problem.variables.push_back({.name = "v", .costs = {-1000, 0, 0.5}, .optional = false});
  for (const auto& scope : {std::vector<Index>{0, 1}, {1, 2}, {0, 2}}) {
    LabelingConstraint constraint = empty_constraint(problem, scope);
    constraint.violations.clear();
    constraint.costs[0] = forbidden;
    if (scope[0] == 0 && scope[1] == 2) constraint.costs[8] = 700;
    problem.constraints.push_back(std::move(constraint));
  }
  for (const char* method : {"elimination", "search"})
    expect_exact(problem, test::solve_posterior(problem, {{"method", method}}), method);
}

TEST(Posterior, NoLabellingOfFiniteCost) {
  LabelingProblem pigeons;  // three in two holes
  pigeons.candidate_count = 2;
  for (Index a = 0; a < 2; ++a) set_conflict(pigeons, a, a);
  for (int i = 0; i < 3; ++i)
    pigeons.variables.push_back({.name = "p", .candidates = {0, 1}, .costs = {0, 0}, .optional = false});
  for (const char* method : {"auto", "elimination", "search"}) {
    const LabelingOutcome outcome = test::solve_posterior(pigeons, {{"method", method}});
    EXPECT_EQ(outcome.log_evidence, -forbidden) << method;
    EXPECT_TRUE(outcome.labelings.empty()) << method;
    EXPECT_TRUE(outcome.posteriors.empty()) << method;
    EXPECT_TRUE(outcome.optimal) << method;
  }
  // Belief propagation cannot know, but gives nothing that is not there.
  EXPECT_TRUE(test::solve_posterior(pigeons, {{"method", "belief-propagation"}}).labelings.empty());
  for (LabelingVariable& variable : pigeons.variables) {
    variable.optional = true;
    variable.costs = {forbidden, 0, 0};
  }
  EXPECT_EQ(test::solve_posterior(pigeons).labelings.size(), 1);  // all missing, at an infinite cost
  EXPECT_EQ(test::solve_posterior(pigeons).log_evidence, -forbidden);
}

TEST(Posterior, EmptyProblemAndProblemsWithoutConstraints) {
  LabelingProblem problem;
  problem.constant = 1.5;
  EXPECT_EQ(test::solve_posterior(problem).log_evidence, -1.5);
  EXPECT_EQ(test::solve_posterior(problem).labelings.size(), 1);
  problem.variables.push_back({.name = "a", .costs = {1, 2, forbidden}});
  problem.variables.push_back({.name = "b", .costs = {0}});
  for (const char* method : {"auto", "elimination", "search"})
    expect_exact(problem, test::solve_posterior(problem, {{"method", method}}), method);
  EXPECT_NEAR(test::solve_posterior(problem, {{"method", "belief-propagation"}}).log_evidence,
              std::log(std::exp(-1) + std::exp(-2)) - 1.5, 1e-12);
}

// What search leaves out is proven: with a coarse tolerance the truth lies within what is stated.
TEST(Posterior, StatedErrorHolds) {
  test::RandomKind kind{.variables = 6, .domain = 5, .arity = 3, .constraints = 8};
  int coarse = 0, bounds = 0;
  for (std::uint64_t seed = 0; seed < 300 && !HasFailure(); ++seed) {
    const LabelingProblem problem = test::random_problem(kind, seed);
    const auto all = test::all_labelings(problem);
    if (all.empty()) continue;
    const auto sums = test::sums(problem, all);
    const LabelingOutcome outcome = test::solve_posterior(problem, {{"method", "search"}, {"tolerance", "0.05"}});
    const double stated = std::stod(test::fact(outcome, "left out")) * (1 + 1e-2) + 1e-12;  // three digits
    EXPECT_LE(stated, 0.0501);
    const double error = 1 - std::exp(outcome.log_evidence - sums.log_evidence);
    EXPECT_GE(error, -1e-12);
    EXPECT_LE(error, stated);
    coarse += error > 1e-6;
    bounds += outcome.evidence_exactness == Exactness::bound && outcome.posterior_exactness == Exactness::bound;
    EXPECT_NEAR(outcome.log_evidence, sums.log_evidence, outcome.evidence_error + 1e-9);
    test::expect_posteriors(outcome, sums.posteriors, outcome.posterior_error + 1e-9);
    test::expect_posteriors(outcome, sums.posteriors, stated);
  }
  EXPECT_GT(coarse, 50);
  EXPECT_GE(bounds, coarse);
}

}  // namespace
