// SPDX-License-Identifier: BSD-3-Clause
// Tree search against brute force, the dissertation's worked example and eight queens.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "base/run_context.h"
#include "support/plugins.h"
#include "toposcope/labeling.h"

namespace {

using namespace toposcope;

constexpr double infinite = std::numeric_limits<double>::infinity();

LabelingConstraint empty_constraint(const LabelingProblem& problem, std::vector<Index> scope) {
  LabelingConstraint constraint;
  constraint.scope = std::move(scope);
  std::size_t entries = 1;
  for (const Index v : constraint.scope) entries *= problem.variables[v].domain();
  constraint.costs.assign(entries, 0);
  constraint.violations.assign(entries, 0);
  return constraint;
}

void set_conflict(LabelingProblem& problem, Index a, Index b) {
  problem.conflict_bits.resize(problem.candidate_count * problem.conflict_words());
  problem.conflict_bits[a * problem.conflict_words() + b / 64] |= std::uint64_t{1} << (b % 64);
  problem.conflict_bits[b * problem.conflict_words() + a / 64] |= std::uint64_t{1} << (a % 64);
}

// Digits of a table entry, last variable fastest.
std::vector<Index> digits(const LabelingProblem& problem, const LabelingConstraint& constraint, std::size_t entry) {
  std::vector<Index> values(constraint.scope.size());
  for (std::size_t k = values.size(); k-- > 0;) {
    const std::size_t domain = problem.variables[constraint.scope[k]].domain();
    values[k] = static_cast<Index>(entry % domain);
    entry /= domain;
  }
  return values;
}

struct RandomKind {
  int variables, domain, arity, constraints;
  bool ties;  // costs and violations in quarters
};

LabelingProblem random_problem(const RandomKind& kind, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    const double x = low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    return kind.ties ? std::round(x * 4) / 4 : x;
  };
  LabelingProblem problem;
  problem.candidate_count = static_cast<Index>(kind.domain + 3);
  for (int i = 0; i < kind.variables; ++i) {
    LabelingVariable variable;
    variable.name = "f" + std::to_string(i);
    variable.detectability = uniform(0.1, 1);
    variable.costs.push_back(uniform(0, 4));
    const int candidates = static_cast<int>(random() % static_cast<std::uint64_t>(kind.domain));
    for (int k = 0; k < candidates; ++k) {
      variable.candidates.push_back(static_cast<Index>(random() % problem.candidate_count));
      variable.costs.push_back(random() % 16 == 0 ? infinite : uniform(-4, 4));
    }
    problem.variables.push_back(variable);
  }
  for (Index a = 0; a < problem.candidate_count; ++a) {
    set_conflict(problem, a, a);
    if (random() % 3 == 0) set_conflict(problem, a, static_cast<Index>(random() % problem.candidate_count));
  }
  for (int c = 0; c < kind.constraints; ++c) {
    std::vector<Index> scope(static_cast<std::size_t>(kind.variables));
    for (Index v = 0; v < scope.size(); ++v) scope[v] = v;
    std::shuffle(scope.begin(), scope.end(), random);
    scope.resize(std::min(scope.size(), 1 + random() % static_cast<std::uint64_t>(kind.arity)));
    LabelingConstraint constraint = empty_constraint(problem, scope);
    constraint.name = "r" + std::to_string(c);
    for (std::size_t entry = 0; entry < constraint.costs.size(); ++entry) {
      const std::vector<Index> values = digits(problem, constraint, entry);
      if (std::find(values.begin(), values.end(), Index{0}) != values.end()) continue;
      constraint.costs[entry] = static_cast<float>(uniform(-3, 5));
      constraint.violations[entry] =
          random() % 12 == 0 ? std::numeric_limits<float>::infinity() : static_cast<float>(uniform(0, 1.6));
    }
    problem.constraints.push_back(constraint);
  }
  return problem;
}

struct Listed {
  Index missing = 0;
  double violation = 0, cost = 0;
  std::vector<Index> values;
};

// Every labelling of finite cost that the rules allow.
std::vector<Listed> all_labelings(const LabelingProblem& problem, bool crisp) {
  std::vector<Listed> all;
  Listed now;
  now.values.assign(problem.variables.size(), 0);
  for (bool more = true; more;) {
    now.missing = static_cast<Index>(std::count(now.values.begin(), now.values.end(), Index{0}));
    now.violation = now.cost = 0;
    bool consistent = true;
    for (std::size_t i = 0; i < now.values.size(); ++i) {
      now.cost += problem.variables[i].costs[now.values[i]];
      for (std::size_t j = 0; j < i; ++j)
        if (now.values[i] > 0 && now.values[j] > 0)
          consistent = consistent && !problem.conflict(problem.variables[i].candidates[now.values[i] - 1],
                                                       problem.variables[j].candidates[now.values[j] - 1]);
    }
    for (const LabelingConstraint& constraint : problem.constraints) {
      std::size_t entry = 0;
      bool untested = false;
      for (const Index v : constraint.scope) {
        entry = entry * problem.variables[v].domain() + now.values[v];
        untested = untested || now.values[v] == 0;
      }
      const double violation = constraint.violations[entry];
      if (crisp && violation > 1) consistent = false;
      now.violation += untested ? 1 : std::min(violation, 1e9);
      now.cost += constraint.costs[entry];
    }
    if (consistent && now.cost < infinite) all.push_back(now);
    more = false;
    for (std::size_t i = now.values.size(); i-- > 0 && !more;) {
      more = ++now.values[i] < problem.variables[i].domain();
      if (!more) now.values[i] = 0;
    }
  }
  return all;
}

struct Mode {
  bool only_if_needed = false, by_violation = false, crisp = true;
  double window = 25;
  test::Settings settings() const {
    return {{"missing", only_if_needed ? "only-if-needed" : "by-cost"},
            {"rank", by_violation ? "violation" : "cost"},
            {"crisp", crisp ? "true" : "false"},
            {"window", std::to_string(window)}};
  }
};

void expect_as_brute_force(const LabelingProblem& problem, const Mode& mode, std::size_t k_best) {
  std::vector<Listed> all = all_labelings(problem, mode.crisp);
  ASSERT_FALSE(all.empty());
  std::sort(all.begin(), all.end(), [&](const Listed& a, const Listed& b) {
    const auto key = [&](const Listed& l) {
      return std::make_tuple(mode.only_if_needed ? l.missing : 0, mode.by_violation ? l.violation : 0.0, l.cost);
    };
    return std::make_pair(key(a), a.values) < std::make_pair(key(b), b.values);
  });
  // Those that compete, and the least cost among them.
  std::vector<Listed> competing;
  for (const Listed& l : all)
    if (!mode.only_if_needed || l.missing == all[0].missing) competing.push_back(l);
  double least = infinite;
  for (const Listed& l : competing) least = std::min(least, l.cost);

  const LabelingOutcome outcome =
      test::labeler("tree-search", mode.settings())->solve(problem, {k_best, 60}, test::context());
  EXPECT_TRUE(outcome.optimal);
  EXPECT_DOUBLE_EQ(outcome.lower_bound, least);

  std::vector<Listed> expected;
  for (const Listed& l : all)
    if (expected.size() < k_best && l.cost <= all[0].cost + mode.window) expected.push_back(l);
  ASSERT_EQ(outcome.labelings.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(outcome.labelings[i].values, expected[i].values) << "rank " << i;
    EXPECT_DOUBLE_EQ(outcome.labelings[i].cost, expected[i].cost);
  }

  double total = 0;
  std::vector<std::vector<double>> posteriors;
  for (const LabelingVariable& variable : problem.variables) posteriors.emplace_back(variable.domain(), 0.0);
  for (const Listed& l : competing) {
    if (l.cost > least + mode.window + 1e-9) continue;
    total += std::exp(least - l.cost);
    for (std::size_t i = 0; i < l.values.size(); ++i) posteriors[i][l.values[i]] += std::exp(least - l.cost);
  }
  EXPECT_NEAR(outcome.log_evidence, std::log(total) - least, 1e-9);
  if (mode.by_violation) {
    EXPECT_TRUE(outcome.posteriors.empty());
    return;
  }
  ASSERT_EQ(outcome.posteriors.size(), problem.variables.size());
  for (std::size_t i = 0; i < posteriors.size(); ++i) {
    double sum = 0;
    for (std::size_t v = 0; v < posteriors[i].size(); ++v) {
      EXPECT_NEAR(outcome.posteriors[i][v], posteriors[i][v] / total, 1e-9);
      sum += outcome.posteriors[i][v];
    }
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST(TreeSearch, AgreesWithBruteForceInEveryMode) {
  const RandomKind kinds[] = {{3, 8, 2, 3, false}, {4, 6, 3, 5, false}, {4, 6, 2, 6, true},
                              {5, 5, 4, 4, true},  {6, 4, 3, 7, false}, {1, 5, 1, 2, true}};
  std::uint64_t seed = 0;
  for (const RandomKind& kind : kinds)
    for (int trial = 0; trial < 100; ++trial) {
      const LabelingProblem problem = random_problem(kind, ++seed);
      SCOPED_TRACE("seed " + std::to_string(seed));
      for (const bool only_if_needed : {false, true})
        for (const bool by_violation : {false, true}) {
          const double window = trial % 3 == 0 ? 2.125 : 25;
          expect_as_brute_force(problem, {only_if_needed, by_violation, trial % 4 != 0, window},
                                trial % 2 == 0 ? 5 : 50);
          if (HasFatalFailure()) return;
        }
    }
}

TEST(TreeSearch, VariableOrderOfTheProblemDoesNotMatter) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const LabelingProblem problem = random_problem({4, 6, 3, 5, false}, seed);
    LabelingProblem reversed = problem;
    std::reverse(reversed.variables.begin(), reversed.variables.end());
    for (LabelingConstraint& constraint : reversed.constraints)
      for (Index& v : constraint.scope) v = static_cast<Index>(problem.variables.size() - 1 - v);
    const auto labeler = test::labeler("tree-search");
    const LabelingOutcome one = labeler->solve(problem, {}, test::context());
    LabelingOutcome other = labeler->solve(reversed, {}, test::context());
    ASSERT_EQ(one.labelings.size(), other.labelings.size());
    for (std::size_t i = 0; i < one.labelings.size(); ++i) {
      std::reverse(other.labelings[i].values.begin(), other.labelings[i].values.end());
      EXPECT_EQ(one.labelings[i].values, other.labelings[i].values);
    }
    EXPECT_NEAR(one.log_evidence, other.log_evidence, 1e-12);
  }
}

// Figure 3.6 and Table 3.1: three features, four working sets, of which w4 is noise.
LabelingProblem worked_example() {
  LabelingProblem problem;
  problem.candidate_count = 4;
  problem.conflict_bits.assign(4, 0);
  for (Index w = 0; w < 4; ++w) set_conflict(problem, w, w);
  for (const auto& [name, detectability] : {std::pair{"f1", 1.0}, {"f2", 0.75}, {"f3", 0.9}})
    problem.variables.push_back({name, detectability, {0, 1, 2, 3}, {3, 0, 0, 0, 0}});
  const auto relate = [&](const char* name, Index f, Index g, std::vector<std::pair<Index, Index>> pairs) {
    LabelingConstraint constraint = empty_constraint(problem, {f, g});
    constraint.name = name;
    for (Index v = 1; v <= 4; ++v)
      for (Index w = 1; w <= 4; ++w) constraint.violations[5 * v + w] = 2;
    for (const auto& [v, w] : pairs) constraint.violations[5 * v + w] = constraint.violations[5 * w + v] = 0.5F;
    problem.constraints.push_back(constraint);
  };
  relate("r1", 0, 2, {{1, 3}, {1, 4}, {3, 4}});
  relate("r2", 0, 1, {{1, 2}, {2, 3}});
  relate("r3", 1, 2, {{2, 3}, {3, 4}});
  return problem;
}

TEST(TreeSearch, WorkedExampleOfTheDissertation) {
  for (const char* missing : {"by-cost", "only-if-needed"})
    for (const char* rank : {"cost", "violation"}) {
      const LabelingOutcome outcome = test::labeler("tree-search", {{"missing", missing}, {"rank", rank}})
                                          ->solve(worked_example(), {50, 60}, test::context());
      EXPECT_EQ(outcome.labelings[0].values, (std::vector<Index>{1, 2, 3}));
      EXPECT_TRUE(outcome.optimal);
      // It is the only one without a missing feature.
      for (std::size_t i = 1; i < outcome.labelings.size(); ++i)
        EXPECT_EQ(std::count(outcome.labelings[i].values.begin(), outcome.labelings[i].values.end(), Index{0}) > 0,
                  true);
    }
}

TEST(TreeSearch, FeaturesEnterByDetectability) {
  std::vector<std::string> lines;
  RunContext context({.threads = 1,
                      .seed = 1,
                      .time_limit_s = {},
                      .log = [&](LogLevel, std::string_view line) { lines.emplace_back(line); },
                      .progress = {}});
  test::labeler("tree-search")->solve(worked_example(), {}, context);
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines[0].find("f1 f3 f2"), std::string::npos) << lines[0];
}

LabelingProblem queens(Index n) {
  LabelingProblem problem;
  problem.candidate_count = n * n;
  problem.conflict_bits.assign(problem.candidate_count * problem.conflict_words(), 0);
  for (Index square = 0; square < n * n; ++square) set_conflict(problem, square, square);
  for (Index row = 0; row < n; ++row) {
    LabelingVariable variable{"row" + std::to_string(row), 1, {}, std::vector<double>(n + 1, 0)};
    for (Index column = 0; column < n; ++column) variable.candidates.push_back(row * n + column);
    problem.variables.push_back(variable);
  }
  for (Index r = 0; r < n; ++r)
    for (Index s = r + 1; s < n; ++s) {
      LabelingConstraint constraint = empty_constraint(problem, {r, s});
      for (Index a = 1; a <= n; ++a)
        for (Index b = 1; b <= n; ++b)
          if (a == b || std::max(a, b) - std::min(a, b) == s - r) constraint.violations[a * (n + 1) + b] = 2;
      problem.constraints.push_back(constraint);
    }
  return problem;
}

TEST(TreeSearch, EightQueensHaveNinetyTwoPlacements) {
  const LabelingOutcome outcome =
      test::labeler("tree-search", {{"missing", "only-if-needed"}})->solve(queens(8), {92, 60}, test::context());
  ASSERT_EQ(outcome.labelings.size(), 92U);
  for (const Labeling& labeling : outcome.labelings)
    EXPECT_EQ(std::count(labeling.values.begin(), labeling.values.end(), Index{0}), 0);
  EXPECT_TRUE(std::is_sorted(outcome.labelings.begin(), outcome.labelings.end(),
                             [](const Labeling& a, const Labeling& b) { return a.values < b.values; }));
  EXPECT_NEAR(outcome.log_evidence, std::log(92.0), 1e-12);
  for (const std::vector<double>& posterior : outcome.posteriors) EXPECT_EQ(posterior[0], 0);
}

TEST(TreeSearch, ThreeQueensCannotAllStand) {
  const LabelingOutcome outcome =
      test::labeler("tree-search", {{"missing", "only-if-needed"}})->solve(queens(3), {1, 60}, test::context());
  const std::vector<Index>& values = outcome.labelings[0].values;
  EXPECT_EQ(std::count(values.begin(), values.end(), Index{0}), 1);
}

TEST(TreeSearch, NothingOfFiniteCostLeavesAllMissing) {
  LabelingProblem problem;
  problem.variables = {{"f", 1, {}, {infinite}}, {"g", 1, {}, {2}}};
  const LabelingOutcome outcome = test::labeler("tree-search")->solve(problem, {}, test::context());
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_EQ(outcome.labelings[0].values, (std::vector<Index>{0, 0}));
  EXPECT_EQ(outcome.log_evidence, -infinite);
  EXPECT_EQ(outcome.posteriors[1], (std::vector<double>{1}));
}

LabelingProblem large_problem() {
  LabelingProblem problem = random_problem({14, 120, 2, 60, false}, 3);
  return problem;
}

TEST(TreeSearch, OutOfTimeKeepsTheBestSoFar) {
  const LabelingProblem problem = large_problem();
  const LabelingOutcome outcome =
      test::labeler("tree-search", {{"crisp", "false"}})->solve(problem, {10, 0.001}, test::context());
  EXPECT_FALSE(outcome.optimal);
  ASSERT_EQ(outcome.labelings.size(), 1U);
  EXPECT_LT(outcome.lower_bound, outcome.labelings[0].cost);
  EXPECT_GT(outcome.lower_bound, -infinite);
  EXPECT_TRUE(std::isfinite(outcome.log_evidence));
  EXPECT_NE(outcome.guarantee.find("not proven"), std::string::npos) << outcome.guarantee;
  for (const std::vector<double>& posterior : outcome.posteriors) {
    double sum = 0;
    for (const double p : posterior) sum += p;
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST(TreeSearch, StoppedBoundsStayBelowTheOptimum) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const LabelingProblem problem = random_problem({9, 24, 2, 20, false}, seed);
    const auto labeler = test::labeler("tree-search", {{"crisp", "false"}, {"window", "0"}});
    const LabelingOutcome whole = labeler->solve(problem, {1, 60}, test::context());
    ASSERT_TRUE(whole.optimal);
    const LabelingOutcome cut = labeler->solve(problem, {1, 0}, test::context());
    EXPECT_LE(cut.lower_bound, whole.lower_bound);
    EXPECT_GE(cut.labelings[0].cost, whole.labelings[0].cost);
  }
}

TEST(TreeSearch, CancelledKeepsTheBestSoFar) {
  RunContext context;
  context.cancel();
  const LabelingOutcome outcome =
      test::labeler("tree-search", {{"crisp", "false"}})->solve(large_problem(), {}, context);
  EXPECT_FALSE(outcome.optimal);
  EXPECT_EQ(outcome.labelings.size(), 1U);
}

TEST(TreeSearch, RefusesTablesThatDoNotFit) {
  LabelingProblem problem = worked_example();
  problem.constraints[1].costs.pop_back();
  EXPECT_ANY_THROW(test::labeler("tree-search")->solve(problem, {}, test::context()));
  problem = worked_example();
  problem.variables[0].costs[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_ANY_THROW(test::labeler("tree-search")->solve(problem, {}, test::context()));
}

}  // namespace
