// SPDX-License-Identifier: BSD-3-Clause
// Marginals and evidence against brute force, transfer matrices and trees.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

LabelingOutcome solve(const LabelingProblem& problem, const test::Settings& settings = {},
                      const LabelingRequest& request = {}) {
  return test::labeler("posterior", settings)->solve(problem, request, test::context());
}

void expect_exact(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& what) {
  SCOPED_TRACE(what);
  const std::vector<Labeling> all = test::all_labelings(problem);
  const test::BruteForce sums = test::sums(problem, all);
  if (all.empty()) {
    EXPECT_EQ(outcome.log_evidence, -forbidden);
    EXPECT_TRUE(outcome.posteriors.empty());
    EXPECT_EQ(outcome.labelings.size(), all_missing(problem).size());
    EXPECT_TRUE(outcome.optimal);
    EXPECT_EQ(outcome.lower_bound, forbidden);
    return;
  }
  EXPECT_NEAR(outcome.log_evidence, sums.log_evidence, 1e-9);
  ASSERT_EQ(outcome.posteriors.size(), sums.posteriors.size());
  for (std::size_t v = 0; v < sums.posteriors.size(); ++v) {
    ASSERT_EQ(outcome.posteriors[v].size(), sums.posteriors[v].size());
    for (std::size_t value = 0; value < sums.posteriors[v].size(); ++value)
      EXPECT_NEAR(outcome.posteriors[v][value], sums.posteriors[v][value], 1e-9) << v << " " << value;
  }
  EXPECT_TRUE(outcome.optimal);
  EXPECT_LE(outcome.lower_bound, all.front().cost);
  EXPECT_NEAR(outcome.lower_bound, all.front().cost, 1e-9);
  ASSERT_EQ(outcome.labelings.size(), std::min<std::size_t>(10, all.size()));
  for (std::size_t k = 0; k < outcome.labelings.size(); ++k) {
    EXPECT_EQ(outcome.labelings[k].values, all[k].values) << k;
    EXPECT_EQ(outcome.labelings[k].cost, all[k].cost) << k;
  }
}

std::string fact(const LabelingOutcome& outcome, const std::string& name) {
  for (const LabelingFact& fact : outcome.facts)
    if (fact.name == name) return fact.value;
  return "";
}

class PosteriorMethods : public ::testing::TestWithParam<const char*> {};

TEST_P(PosteriorMethods, AreBruteForce) {
  int proven = 0, impossible = 0;
  for (std::uint64_t seed = 0; seed < 2000 && !HasFailure(); ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const LabelingOutcome outcome = solve(problem, {{"method", GetParam()}});
    expect_exact(problem, outcome, "seed " + std::to_string(seed));
    EXPECT_EQ(outcome.guarantee.substr(0, 5), "exact") << outcome.guarantee;
    proven += fact(outcome, "method") == GetParam();
    impossible += outcome.labelings.empty();
  }
  EXPECT_GT(proven, std::string(GetParam()) == "auto" ? -1 : 1500);
  EXPECT_GT(impossible, 20);
}
INSTANTIATE_TEST_SUITE_P(All, PosteriorMethods, ::testing::Values("auto", "elimination", "search"));

/// A forest: variable i > 0 hangs on a variable before it, now and then on none, or two hang on one by a ternary table.
LabelingProblem random_forest(std::uint64_t seed) {
  test::RandomKind kind;
  kind.variables = 2 + static_cast<int>(seed % 5);
  kind.constraints = 0;
  LabelingProblem problem = test::random_problem(kind, seed);
  for (LabelingVariable& variable : problem.variables) variable.candidates.clear();
  std::uint64_t state = seed;
  const auto draw = [&] { return (state = state * 6364136223846793005ULL + 1442695040888963407ULL) >> 33; };
  for (Index v = 1; v < problem.variables.size(); ++v) {
    if (draw() % 5 == 0) continue;
    std::vector<Index> scope{static_cast<Index>(draw() % v), v};
    if (v + 1 < problem.variables.size() && draw() % 3 == 0) scope.insert(scope.begin(), ++v);
    LabelingConstraint constraint = test::empty_constraint(problem, scope);
    for (double& cost : constraint.costs)
      cost = draw() % 8 == 0 ? forbidden : static_cast<double>(draw() % 1000) / 100 - 5;
    problem.constraints.push_back(std::move(constraint));
  }
  return problem;
}

TEST(Posterior, BeliefPropagationIsExactOnForests) {
  int propagated = 0;
  for (std::uint64_t seed = 0; seed < 500 && !HasFailure(); ++seed) {
    const LabelingProblem problem = random_forest(seed);
    const LabelingOutcome outcome = solve(problem, {{"method", "belief-propagation"}});
    SCOPED_TRACE(seed);
    EXPECT_EQ(outcome.guarantee.substr(0, 5), "exact") << outcome.guarantee;
    const auto all = test::all_labelings(problem);
    const auto sums = test::sums(problem, all);
    if (all.empty()) {
      EXPECT_EQ(outcome.log_evidence, -forbidden);
      continue;
    }
    ++propagated;
    EXPECT_EQ(fact(outcome, "converged"), "yes");
    EXPECT_NEAR(outcome.log_evidence, sums.log_evidence, 1e-9);
    for (std::size_t v = 0; v < sums.posteriors.size(); ++v)
      for (std::size_t value = 0; value < sums.posteriors[v].size(); ++value)
        EXPECT_NEAR(outcome.posteriors[v][value], sums.posteriors[v][value], 1e-9);
    ASSERT_FALSE(outcome.labelings.empty());
    EXPECT_LE(outcome.lower_bound, all.front().cost);
  }
  EXPECT_GT(propagated, 400);
}

TEST(Posterior, LoopyBeliefPropagationSaysSoAndIsNear) {
  double worst = 0, mean = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 1000 && !HasFailure(); ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const auto all = test::all_labelings(problem);
    const LabelingOutcome outcome = solve(problem, {{"method", "belief-propagation"}});
    if (all.empty() || outcome.guarantee.substr(0, 5) == "exact") continue;
    EXPECT_EQ(outcome.guarantee.substr(0, 11), "approximate") << outcome.guarantee;
    EXPECT_NE(fact(outcome, "sweeps"), "");
    EXPECT_NE(fact(outcome, "residual"), "");
    EXPECT_FALSE(outcome.optimal);
    for (const Labeling& labeling : outcome.labelings) {
      EXPECT_TRUE(meets_exclusions(problem, labeling.values));
      EXPECT_EQ(labeling.cost, cost_of(problem, labeling.values));
    }
    EXPECT_LE(outcome.lower_bound, all.front().cost);
    const auto sums = test::sums(problem, all);
    for (std::size_t v = 0; v < sums.posteriors.size(); ++v) {
      double total = 0;
      for (std::size_t value = 0; value < sums.posteriors[v].size(); ++value) {
        total += outcome.posteriors[v][value];
        const double error = std::abs(outcome.posteriors[v][value] - sums.posteriors[v][value]);
        worst = std::max(worst, error);
        mean += error;
        ++count;
      }
      EXPECT_NEAR(total, 1, 1e-12);
    }
  }
  ASSERT_GT(count, 1000);
  EXPECT_LT(mean / count, 0.02);
  EXPECT_GT(worst, 1e-6);  // else it would be the exact method
}

LabelingProblem chain(Index length, double scale) {
  LabelingProblem problem;
  for (Index v = 0; v < length; ++v) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "x" + std::to_string(v);
    variable.optional = false;
    variable.costs = {scale * std::sin(v + 1.0), scale * std::cos(3.0 * v)};
  }
  for (Index v = 0; v + 1 < length; ++v) {
    LabelingConstraint constraint = test::empty_constraint(problem, {v, v + 1});
    constraint.violations.clear();
    for (Index e = 0; e < 4; ++e) constraint.costs[e] = scale * std::sin(5.0 * v + 2.0 * e);
    problem.constraints.push_back(std::move(constraint));
  }
  return problem;
}

// exp(-cost) multiplied along the chain from both ends, scaled at each step: what is known of transfer matrices.
TEST(Posterior, ChainIsTransferMatrices) {
  const Index n = 120;
  const LabelingProblem problem = chain(n, 1);
  const auto weight = [](double cost) { return std::exp(-cost); };
  std::vector<std::array<double, 2>> left(n), right(n);
  double log_evidence = 0;
  for (Index v = 0; v < n; ++v) {
    for (Index b = 0; b < 2; ++b) {
      double sum = v == 0 ? 1 : 0;
      if (v > 0)
        for (Index a = 0; a < 2; ++a) sum += left[v - 1][a] * weight(problem.constraints[v - 1].costs[2 * a + b]);
      left[v][b] = sum * weight(problem.variables[v].costs[b]);
    }
    const double scale = left[v][0] + left[v][1];
    log_evidence += std::log(scale);
    for (double& x : left[v]) x /= scale;
  }
  right[n - 1] = {1, 1};
  for (Index v = n - 1; v-- > 0;) {
    for (Index a = 0; a < 2; ++a) {
      right[v][a] = 0;
      for (Index b = 0; b < 2; ++b)
        right[v][a] +=
            weight(problem.constraints[v].costs[2 * a + b] + problem.variables[v + 1].costs[b]) * right[v + 1][b];
    }
    const double scale = right[v][0] + right[v][1];
    for (double& x : right[v]) x /= scale;
  }
  for (const char* method : {"auto", "elimination", "belief-propagation"}) {
    const LabelingOutcome outcome = solve(problem, {{"method", method}});
    EXPECT_EQ(outcome.guarantee.substr(0, 5), "exact") << outcome.guarantee;
    EXPECT_NEAR(outcome.log_evidence, log_evidence, 1e-9) << method;
    for (Index v = 0; v < n; ++v) {
      const double sum = left[v][0] * right[v][0] + left[v][1] * right[v][1];
      for (Index b = 0; b < 2; ++b)
        EXPECT_NEAR(outcome.posteriors[v][b], left[v][b] * right[v][b] / sum, 1e-9) << method << " " << v;
    }
  }
  // The best labelling of a chain is Viterbi's.
  std::array<double, 2> best = {problem.variables[0].costs[0], problem.variables[0].costs[1]};
  for (Index v = 1; v < n; ++v) {
    const auto step = [&](Index b) {
      return problem.variables[v].costs[b] +
             std::min(best[0] + problem.constraints[v - 1].costs[b], best[1] + problem.constraints[v - 1].costs[2 + b]);
    };
    best = {step(0), step(1)};
  }
  const LabelingOutcome outcome = solve(problem, {{"method", "elimination"}});
  EXPECT_TRUE(outcome.optimal);
  EXPECT_NEAR(outcome.labelings.front().cost, std::min(best[0], best[1]), 1e-9);
  EXPECT_EQ(outcome.labelings.size(), 10);
}

TEST(Posterior, CostsOfTenThousandNatsDoNotUnderflow) {
  const LabelingProblem problem = chain(12, 1e4);
  const auto all = test::all_labelings(problem);
  const auto sums = test::sums(problem, all);
  EXPECT_LT(all.front().cost, -1e4);
  EXPECT_GT(all.back().cost, 1e4);
  for (const char* method : {"auto", "elimination", "search", "belief-propagation"}) {
    const LabelingOutcome outcome = solve(problem, {{"method", method}});
    EXPECT_NEAR(outcome.log_evidence, sums.log_evidence, 1e-7) << method;
    for (std::size_t v = 0; v < sums.posteriors.size(); ++v)
      for (std::size_t value = 0; value < 2; ++value)
        EXPECT_NEAR(outcome.posteriors[v][value], sums.posteriors[v][value], 1e-7) << method;
    EXPECT_EQ(outcome.labelings.front().values, all.front().values) << method;
  }
}

// The cheap values lead nowhere: the bound lies 2,000 nats below the only labellings there are.
TEST(Posterior, BoundFarBelowTheEvidence) {
  LabelingProblem problem;
  for (int i = 0; i < 3; ++i) problem.variables.push_back({.name = "v", .costs = {-1000, 0, 0.5}, .optional = false});
  for (const auto& scope : {std::vector<Index>{0, 1}, {1, 2}, {0, 2}}) {
    LabelingConstraint constraint = test::empty_constraint(problem, scope);
    constraint.violations.clear();
    constraint.costs[0] = forbidden;
    if (scope[0] == 0 && scope[1] == 2) constraint.costs[8] = 700;
    problem.constraints.push_back(std::move(constraint));
  }
  for (const char* method : {"elimination", "search"})
    expect_exact(problem, solve(problem, {{"method", method}}), method);
}

TEST(Posterior, NoLabellingOfFiniteCost) {
  LabelingProblem pigeons;  // three in two holes
  pigeons.candidate_count = 2;
  for (Index a = 0; a < 2; ++a) test::set_conflict(pigeons, a, a);
  for (int i = 0; i < 3; ++i)
    pigeons.variables.push_back({.name = "p", .candidates = {0, 1}, .costs = {0, 0}, .optional = false});
  for (const char* method : {"auto", "elimination", "search"}) {
    const LabelingOutcome outcome = solve(pigeons, {{"method", method}});
    EXPECT_EQ(outcome.log_evidence, -forbidden) << method;
    EXPECT_TRUE(outcome.labelings.empty()) << method;
    EXPECT_TRUE(outcome.posteriors.empty()) << method;
    EXPECT_TRUE(outcome.optimal) << method;
  }
  // Belief propagation cannot know, but gives nothing that is not there.
  EXPECT_TRUE(solve(pigeons, {{"method", "belief-propagation"}}).labelings.empty());
  for (LabelingVariable& variable : pigeons.variables) {
    variable.optional = true;
    variable.costs = {forbidden, 0, 0};
  }
  EXPECT_EQ(solve(pigeons).labelings.size(), 1);  // all missing, at an infinite cost
  EXPECT_EQ(solve(pigeons).log_evidence, -forbidden);
}

TEST(Posterior, EmptyProblemAndProblemsWithoutConstraints) {
  LabelingProblem problem;
  problem.constant = 1.5;
  EXPECT_EQ(solve(problem).log_evidence, -1.5);
  EXPECT_EQ(solve(problem).labelings.size(), 1);
  problem.variables.push_back({.name = "a", .costs = {1, 2, forbidden}});
  problem.variables.push_back({.name = "b", .costs = {0}});
  for (const char* method : {"auto", "elimination", "search"})
    expect_exact(problem, solve(problem, {{"method", method}}), method);
  EXPECT_NEAR(solve(problem, {{"method", "belief-propagation"}}).log_evidence,
              std::log(std::exp(-1) + std::exp(-2)) - 1.5, 1e-12);
}

// What search leaves out is proven: with a coarse tolerance the truth lies within what is stated.
TEST(Posterior, StatedErrorHolds) {
  test::RandomKind kind{.variables = 6, .domain = 5, .arity = 3, .constraints = 8};
  int coarse = 0;
  for (std::uint64_t seed = 0; seed < 300 && !HasFailure(); ++seed) {
    const LabelingProblem problem = test::random_problem(kind, seed);
    const auto all = test::all_labelings(problem);
    if (all.empty()) continue;
    const auto sums = test::sums(problem, all);
    const LabelingOutcome outcome = solve(problem, {{"method", "search"}, {"tolerance", "0.05"}});
    const double stated = std::stod(fact(outcome, "left out")) * (1 + 1e-2) + 1e-12;  // three digits
    EXPECT_LE(stated, 0.0501);
    const double error = 1 - std::exp(outcome.log_evidence - sums.log_evidence);
    EXPECT_GE(error, -1e-12);
    EXPECT_LE(error, stated);
    coarse += error > 1e-6;
    for (std::size_t v = 0; v < sums.posteriors.size(); ++v)
      for (std::size_t value = 0; value < sums.posteriors[v].size(); ++value)
        EXPECT_NEAR(outcome.posteriors[v][value], sums.posteriors[v][value], stated);
  }
  EXPECT_GT(coarse, 50);
}

LabelingProblem large(Index variables, Index candidates, int tables) {
  LabelingProblem problem;
  problem.candidate_count = 2 * candidates;
  std::uint64_t state = 1;
  const auto draw = [&] { return static_cast<double>((state = state * 6364136223846793005ULL + 1) >> 11) * 0x1p-53; };
  for (Index v = 0; v < variables; ++v) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "f" + std::to_string(v);
    variable.costs.push_back(2);
    for (Index k = 0; k < candidates; ++k) {
      variable.candidates.push_back(static_cast<Index>(draw() * problem.candidate_count));
      variable.costs.push_back(6 * draw() - 2);
    }
  }
  for (Index a = 0; a < problem.candidate_count; ++a) test::set_conflict(problem, a, a);
  for (Index v = 0; v < variables; ++v)
    for (Index w = v + 1; w < variables; ++w) {
      if (draw() * variables * (variables - 1) / 2 > tables) continue;
      LabelingConstraint constraint = test::empty_constraint(problem, {v, w});
      constraint.violations.clear();
      for (Index e = 0; e < constraint.costs.size(); ++e)
        if (e % (candidates + 1) != 0 && e > candidates) constraint.costs[e] = 6 * draw() - 2;
      problem.constraints.push_back(std::move(constraint));
    }
  return problem;
}

TEST(Posterior, TimeLimitAndCancelling) {
  const LabelingProblem problem = large(40, 59, 400);
  for (const char* method : {"auto", "elimination", "search", "belief-propagation"})
    for (const double limit_s : {0.0, 0.001, 0.02, 0.3}) {
      const LabelingOutcome outcome = solve(problem, {{"method", method}}, {.time_limit_s = limit_s});
      SCOPED_TRACE(method + std::to_string(limit_s) + outcome.guarantee);
      ASSERT_FALSE(outcome.labelings.empty());
      for (const Labeling& labeling : outcome.labelings) {
        EXPECT_TRUE(meets_exclusions(problem, labeling.values));
        EXPECT_EQ(labeling.cost, cost_of(problem, labeling.values));
        EXPECT_LE(outcome.lower_bound, labeling.cost);
      }
      EXPECT_FALSE(outcome.optimal);
      EXPECT_NE(outcome.guarantee, "");
      for (const std::vector<double>& posterior : outcome.posteriors)
        EXPECT_NEAR(std::accumulate(posterior.begin(), posterior.end(), 0.0), 1, 1e-9);
    }
}

// More nodes than are tried at once: sums are made from coarse to fine, and each states its error.
TEST(Posterior, SumsFromCoarseToFineHoldWhatTheyState) {
  const LabelingProblem problem = large(7, 9, 12);
  const LabelingOutcome exact = solve(problem, {{"method", "elimination"}});
  ASSERT_EQ(exact.guarantee.substr(0, 5), "exact");
  for (const double limit_s : {0.05, 0.2, 0.8, 60.0}) {
    const LabelingOutcome outcome = solve(problem, {{"method", "search"}}, {.time_limit_s = limit_s});
    SCOPED_TRACE(std::to_string(limit_s) + " s: " + outcome.guarantee);
    EXPECT_LE(outcome.lower_bound, exact.labelings.front().cost);
    if (fact(outcome, "method") != "search") continue;  // out of time before the first
    const double stated = std::stod(fact(outcome, "left out")) * 1.01 + 1e-11;
    EXPECT_EQ(outcome.guarantee.substr(0, 5), stated < 2e-11 ? "exact" : "stopp");
    EXPECT_NEAR(outcome.log_evidence, exact.log_evidence, 1.2 * stated);
    for (std::size_t v = 0; v < exact.posteriors.size(); ++v)
      for (std::size_t value = 0; value < exact.posteriors[v].size(); ++value)
        EXPECT_NEAR(outcome.posteriors[v][value], exact.posteriors[v][value], stated);
    EXPECT_EQ(outcome.labelings.front().values, exact.labelings.front().values);
  }
}

TEST(Posterior, SameAnswerEveryRun) {
  const LabelingProblem problem = large(6, 9, 9);
  for (const char* method : {"auto", "elimination", "search", "belief-propagation"}) {
    const LabelingOutcome a = solve(problem, {{"method", method}, {"max_entries", "1e9"}});
    const LabelingOutcome b = solve(problem, {{"method", method}, {"max_entries", "1e9"}});
    EXPECT_EQ(a.log_evidence, b.log_evidence) << method;
    EXPECT_EQ(a.posteriors, b.posteriors) << method;
    EXPECT_EQ(a.labelings.front().values, b.labelings.front().values) << method;
  }
}

}  // namespace
