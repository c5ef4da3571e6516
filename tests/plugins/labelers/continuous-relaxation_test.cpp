// SPDX-License-Identifier: BSD-3-Clause
// Relaxation labelling decoded: sound on every problem. What the weights do is tested in tests/core/labeling.

#include <gtest/gtest.h>

#include <algorithm>

#include "base/run_context.h"
#include "support/labeler_checks.h"
#include "support/labeling_problems.h"
#include "support/planted_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;

constexpr const char* updates[] = {"projected-gradient", "rosenfeld-hummel-zucker"};

// \return how many of 2,000 random problems end at the optimum, in hundredths
int hits(const test::Settings& settings) {
  const auto labeler = test::labeler("continuous-relaxation", settings);
  int solvable = 0, best = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const std::vector<Labeling> all = test::all_labelings(problem);
    const LabelingOutcome outcome = labeler->solve(problem, {.k_best = 3}, test::context());
    EXPECT_TRUE(outcome.posteriors.empty());
    SCOPED_TRACE(seed);
    solvable += !all.empty();
    best += test::expect_honest(problem, outcome, all);
  }
  return best * 100 / solvable;
}

TEST(ContinuousRelaxation, SoundOnRandomProblemsAndMostlyBest) {
  for (const char* update : updates) {
    const int improved = hits({{"update", update}}), plain = hits({{"update", update}, {"improve", "false"}});
    EXPECT_GE(improved, 95) << update;
    EXPECT_GE(plain, 93) << update;
    EXPECT_LE(plain, improved) << update;
  }
}

TEST(ContinuousRelaxation, WithoutConstraintsTakesTheLeastCosts) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    LabelingProblem problem = test::random_problem({.variables = 5, .domain = 6, .constraints = 0}, seed);
    for (LabelingVariable& variable : problem.variables) variable.candidates.clear();
    for (const char* update : updates)
      for (const char* evidence : {"lasting", "initial"}) {
        const LabelingOutcome outcome =
            test::labeler("continuous-relaxation", {{"update", update}, {"evidence", evidence}, {"improve", "false"}})
                ->solve(problem, {}, test::context());
        ASSERT_EQ(outcome.labelings.size(), 1U);
        for (Index v = 0; v < problem.variables.size(); ++v) {
          const std::vector<double>& costs = problem.variables[v].costs;
          EXPECT_EQ(outcome.labelings[0].values[v], std::min_element(costs.begin(), costs.end()) - costs.begin());
        }
        EXPECT_TRUE(outcome.optimal);
      }
  }
}

TEST(ContinuousRelaxation, FindsAPlantedLabellingAndSaysHow) {
  std::vector<Index> truth;
  const LabelingProblem problem = test::planted_problem({.features = 20, .candidates = 30}, 2, &truth);
  for (const char* update : updates) {
    const auto labeler = test::labeler("continuous-relaxation", {{"update", update}, {"improve", "false"}});
    const LabelingOutcome outcome = labeler->solve(problem, {.time_limit_s = 600}, test::context());
    ASSERT_EQ(outcome.labelings.size(), 1U);
    EXPECT_LE(outcome.labelings[0].cost, cost_of(problem, truth) + 1) << update;  // of some -278 nats
    EXPECT_GT(std::stod(test::fact(outcome, "average local consistency at end")),
              std::stod(test::fact(outcome, "average local consistency at start")));
    EXPECT_LT(std::stod(test::fact(outcome, "entropy at end, nats per variable")),
              std::stod(test::fact(outcome, "entropy at start, nats per variable")));
    EXPECT_EQ(test::fact(outcome, "iterations"), std::to_string(outcome.nodes));
    EXPECT_NE(test::fact(outcome, "ended by"), "");
    EXPECT_NE(test::fact(outcome, "most ambiguous variable"), "");
    const LabelingOutcome again = labeler->solve(problem, {.time_limit_s = 600}, test::context(2));
    EXPECT_EQ(again.labelings[0].values, outcome.labelings[0].values);
    EXPECT_EQ(test::fact(again, "average local consistency at end"),
              test::fact(outcome, "average local consistency at end"));
  }
}

TEST(ContinuousRelaxation, NamesTheMostAmbiguousVariable) {
  LabelingProblem problem;
  problem.variables = {{.name = "sure", .costs = {0, 5}, .optional = false},
                       {.name = "torn", .costs = {0, 0}, .optional = false}};
  const LabelingOutcome outcome =
      test::labeler("continuous-relaxation", {{"evidence", "initial"}})->solve(problem, {}, test::context());
  EXPECT_EQ(test::fact(outcome, "most ambiguous variable"), "torn (0.5)");
  EXPECT_EQ(test::fact(outcome, "converged"), "yes");
  EXPECT_EQ(test::fact(outcome, "iterations"), "0");
}

TEST(ContinuousRelaxation, QueensAndWhereNothingIs) {
  const LabelingOutcome outcome =
      test::labeler("continuous-relaxation")->solve(test::queens(8), {.time_limit_s = 600}, test::context());
  ASSERT_FALSE(outcome.labelings.empty());
  EXPECT_EQ(outcome.labelings[0].cost, 0);
  for (const Index n : {2U, 3U}) {
    const LabelingOutcome none = test::labeler("continuous-relaxation")->solve(test::queens(n), {}, test::context());
    EXPECT_TRUE(none.labelings.empty());
    EXPECT_EQ(none.optimal, n == 2);  // one table forbids everything; of three queens it does not know
  }
  const LabelingOutcome empty = test::labeler("continuous-relaxation")->solve({}, {}, test::context());
  ASSERT_EQ(empty.labelings.size(), 1U);
  EXPECT_TRUE(empty.optimal);
}

TEST(ContinuousRelaxation, OutOfTimeKeepsWhatItHas) {
  const LabelingProblem problem = test::planted_problem({.features = 40, .candidates = 60}, 1);
  for (const double limit : {0.0, 1e-3, 0.03}) {
    const LabelingOutcome outcome =
        test::labeler("continuous-relaxation")->solve(problem, {.time_limit_s = limit}, test::context());
    ASSERT_FALSE(outcome.labelings.empty());
    EXPECT_TRUE(meets_exclusions(problem, outcome.labelings[0].values));
    EXPECT_LE(outcome.lower_bound, outcome.labelings[0].cost);
  }
  RunContext cancelled;
  cancelled.cancel();
  EXPECT_FALSE(test::labeler("continuous-relaxation")->solve(problem, {}, cancelled).labelings.empty());
}

TEST(ContinuousRelaxation, RefusesTablesThatDoNotFit) {
  LabelingProblem problem = test::queens(4);
  problem.constraints[0].costs.pop_back();
  EXPECT_ANY_THROW(test::labeler("continuous-relaxation")->solve(problem, {}, test::context()));
}

}  // namespace
