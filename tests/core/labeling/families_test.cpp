// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "toposcope/labeling/tools.h"
#include "toposcope/system/random.h"

namespace toposcope {
namespace {

/// Every labelling of a problem without families.
LabelingOutcome list_all(const LabelingProblem& problem, const LabelingRequest& request) {
  check(problem);
  LabelingOutcome outcome;
  BestLabelings best(std::max<std::size_t>(request.k_best, 1), request.within);
  std::vector<std::vector<double>> sums;
  for (const LabelingVariable& variable : problem.variables) sums.emplace_back(variable.domain(), 0);
  double total = 0;
  std::vector<Index> values(problem.variables.size(), 0);
  const std::function<void(Index)> extend = [&](Index v) {
    if (v == values.size()) {
      const double cost = cost_of(problem, values);
      if (!(cost < forbidden)) return;
      best.offer({values, cost});
      total += std::exp(-cost);
      for (Index w = 0; w < values.size(); ++w) sums[w][values[w]] += std::exp(-cost);
      return;
    }
    for (values[v] = 0; values[v] < problem.variables[v].domain(); ++values[v]) extend(v + 1);
    values[v] = 0;
  };
  extend(0);
  for (auto& of : sums)
    for (double& each : of) each /= total;
  outcome.labelings = best.take();
  outcome.lower_bound = outcome.labelings.empty() ? forbidden : outcome.labelings[0].cost;
  outcome.optimal = true;
  outcome.log_evidence = std::log(total);
  outcome.posteriors = std::move(sums);
  outcome.evidence_exactness = outcome.posterior_exactness = Exactness::exact;
  return outcome;
}

struct Enumerated {
  std::vector<double> costs;  ///< ascending
  double evidence = 0;
  std::vector<std::vector<double>> posteriors, numbers;
};

/// Every labelling of a problem with families.
Enumerated list_all(const FamilyProblem& families) {
  const LabelingProblem& problem = families.problem;
  Enumerated all;
  for (const LabelingVariable& variable : problem.variables) all.posteriors.emplace_back(variable.domain(), 0);
  for (const Family& family : families.families)
    all.numbers.emplace_back(problem.variables[family.variable].domain(), 0);
  FamilyLabeling labeling{std::vector<Index>(problem.variables.size(), 0),
                          std::vector<std::vector<Index>>(families.families.size()), 0};
  const auto add = [&] {
    const double cost = cost_of(families, labeling);
    if (!(cost < forbidden)) return;
    const double weight = std::exp(-cost);
    all.costs.push_back(cost);
    all.evidence += weight;
    std::vector<bool> is_family(problem.variables.size(), false);
    for (std::size_t f = 0; f < families.families.size(); ++f) {
      const Index v = families.families[f].variable;
      is_family[v] = true;
      all.numbers[f][labeling.instances[f].size()] += weight;
      if (labeling.instances[f].empty()) all.posteriors[v][0] += weight;
      for (const Index value : labeling.instances[f]) all.posteriors[v][value] += weight;
    }
    for (Index v = 0; v < is_family.size(); ++v)
      if (!is_family[v]) all.posteriors[v][labeling.values[v]] += weight;
  };
  const std::function<void(Index)> extend = [&](Index v) {
    if (v == problem.variables.size()) return add();
    const auto family = std::find_if(families.families.begin(), families.families.end(),
                                     [&](const Family& each) { return each.variable == v; });
    if (family == families.families.end()) {
      for (Index value = 0; value < problem.variables[v].domain(); ++value) {
        labeling.values[v] = value;
        extend(v + 1);
      }
      labeling.values[v] = 0;
      return;
    }
    std::vector<Index>& set = labeling.instances[static_cast<std::size_t>(family - families.families.begin())];
    const Index candidates = problem.variables[v].domain() - 1;
    for (std::uint32_t bits = 0; bits < (1U << candidates); ++bits) {
      set.clear();
      for (Index value = 1; value <= candidates; ++value)
        if ((bits >> (value - 1)) & 1U) set.push_back(value);
      extend(v + 1);
    }
    set.clear();
  };
  extend(0);
  std::sort(all.costs.begin(), all.costs.end());
  for (auto* table : {&all.posteriors, &all.numbers})
    for (auto& of : *table)
      for (double& each : of) each /= all.evidence;
  return all;
}

/// Small problems, no two alike: families with single features, pairs, exclusions within and between them.
class RandomFamilies {
 public:
  explicit RandomFamilies(std::uint64_t seed) : random_(splitmix64(seed)) {}

  FamilyProblem problem() {
    FamilyProblem made;
    LabelingProblem& problem = made.problem;
    problem.constant = uniform(-1, 1);
    const Index families = 1 + below(2), singles = below(4);
    problem.candidate_count = 4 + below(5);
    problem.conflict_bits.assign(problem.candidate_count, 0);
    const double density = uniform(0, 0.5);
    for (Index a = 0; a < problem.candidate_count; ++a)
      for (Index b = 0; b <= a; ++b)
        if (a == b || uniform(0, 1) < density) {
          problem.conflict_bits[a] |= std::uint64_t{1} << b;
          problem.conflict_bits[b] |= std::uint64_t{1} << a;
        }
    for (Index v = 0; v < families + singles; ++v) {
      const bool family = v < families;
      LabelingVariable& variable = problem.variables.emplace_back();
      variable.name = (family ? "family" : "single") + std::to_string(v);
      for (Index c = 0; c < problem.candidate_count; ++c)
        if (uniform(0, 1) < (family ? 5.0 : 2.0) / problem.candidate_count) variable.candidates.push_back(c);
      variable.costs.push_back(family ? 0 : uniform(0, 3));
      for (std::size_t c = 0; c < variable.candidates.size(); ++c) variable.costs.push_back(cost(0.05));
      if (!family) continue;
      Family& each = made.families.emplace_back();
      each.variable = v;
      const Index most = 1 + below(6);
      for (Index k = 0; k <= most; ++k) each.number_costs.push_back(cost(k == 0 ? 0 : 0.1));
    }
    for (Index f = 0; f < families; ++f) {
      if (uniform(0, 1) < 0.5) add(made, {f, f});
      if (singles > 0 && uniform(0, 1) < 0.8) add(made, {f, families + below(singles)});
      if (singles > 0 && uniform(0, 1) < 0.2) add(made, {f, f, families + below(singles)});
      if (singles > 1 && uniform(0, 1) < 0.4) add(made, {families, f, families + 1});
      if (uniform(0, 1) < 0.2) add(made, {f});
    }
    if (singles > 1) add(made, {families, families + 1});
    return made;
  }

 private:
  double uniform(double low, double high) { return low + (high - low) * uniform_closed_open(random_()); }
  Index below(Index count) { return static_cast<Index>(uniform(0, count)); }
  double cost(double never) { return uniform(0, 1) < never ? forbidden : uniform(-4, 3); }

  void add(FamilyProblem& made, std::vector<Index> scope) {
    const LabelingProblem& problem = made.problem;
    LabelingConstraint constraint{"r" + std::to_string(problem.constraints.size()), std::move(scope), {}, {}};
    const double never = uniform(0, 0.4);
    std::vector<Index> digits(constraint.scope.size(), 0);
    do {
      bool missing = false;
      for (const Index digit : digits) missing = missing || digit == 0;
      constraint.costs.push_back(missing ? 0 : cost(never));
    } while (next_entry(problem, constraint, digits));
    made.problem.constraints.push_back(std::move(constraint));
  }

  std::mt19937_64 random_;
};

void expect_near(const std::vector<std::vector<double>>& found, const std::vector<std::vector<double>>& right,
                 const std::string& what) {
  ASSERT_EQ(found.size(), right.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t k = 0; k < right[i].size(); ++k)
      EXPECT_NEAR(k < found[i].size() ? found[i][k] : 0, right[i][k], 1e-9) << what << " " << i << ", " << k;
}

TEST(FamilySums, AgreeWithBruteForce) {
  const SolveProblem solve = [](const auto& problem, const auto& request) { return list_all(problem, request); };
  int with_pairs = 0, with_cases = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(seed);
    const FamilyProblem problem = RandomFamilies(seed).problem();
    const Enumerated right = list_all(problem);
    for (const LabelingConstraint& constraint : problem.problem.constraints) {
      with_pairs += constraint.scope[0] == constraint.scope.back() ? 1 : 0;
      with_cases += constraint.scope.size() == 3 ? 1 : 0;
    }
    LabelingRequest request;
    request.k_best = 7;
    const FamilyOutcome best = best_with_families(problem, request, solve);
    ASSERT_EQ(best.labelings.size(), std::min<std::size_t>(7, right.costs.size()));
    for (std::size_t k = 0; k < best.labelings.size(); ++k) {
      EXPECT_NEAR(best.labelings[k].cost, right.costs[k], 1e-9) << "the labelling of rank " << k;
      for (std::size_t other = 0; other < k; ++other)
        EXPECT_FALSE(best.labelings[k].values == best.labelings[other].values &&
                     best.labelings[k].instances == best.labelings[other].instances);
    }
    EXPECT_TRUE(best.outcome.optimal);
    EXPECT_NEAR(best.outcome.lower_bound, right.costs[0], 1e-9);

    const FamilyOutcome sums = sum_with_families(problem, request, solve);
    EXPECT_NEAR(sums.outcome.log_evidence, std::log(right.evidence), 1e-9);
    expect_near(sums.outcome.posteriors, right.posteriors, "posterior");
    expect_near(sums.numbers, right.numbers, "number");
    if (HasFailure()) return;
  }
  EXPECT_GT(with_pairs, 100);
  EXPECT_GT(with_cases, 100);
}

/// Sixty holes, each by five nested candidates that exclude each other, and one over all of them.
FamilyProblem sixty_holes(double gain) {
  FamilyProblem made;
  LabelingProblem& problem = made.problem;
  constexpr Index holes = 60, nested = 5;
  problem.candidate_count = holes * nested + 1;
  problem.conflict_bits.assign(problem.candidate_count * problem.conflict_words(), 0);
  const auto exclude = [&](Index a, Index b) {
    problem.conflict_bits[a * problem.conflict_words() + b / 64] |= std::uint64_t{1} << (b % 64);
  };
  LabelingVariable& hole = problem.variables.emplace_back();
  hole.name = "hole";
  hole.costs = {0};
  for (Index a = 0; a < problem.candidate_count; ++a) {
    hole.candidates.push_back(a);
    hole.costs.push_back(a + 1 == problem.candidate_count ? -2 * gain : -gain - 0.01 * (a % nested));
    for (Index b = 0; b < problem.candidate_count; ++b)
      if (a / nested == b / nested || a + 1 == problem.candidate_count || b + 1 == problem.candidate_count)
        exclude(a, b);
  }
  made.families.push_back({0, std::vector<double>(101, 0)});
  return made;
}

/// 1 + x s for each hole, and x w for the one over all, where s is the sum over its nested candidates.
TEST(FamilySums, SixtyHolesInClosedForm) {
  for (const double gain : {1.0, 60.0}) {
    const FamilyProblem problem = sixty_holes(gain);
    const FamilyOutcome sums = sum_with_families(problem, {}, {});
    double nested = 0;
    for (int i = 0; i < 5; ++i) nested += std::exp(0.01 * i);
    const double of_hole = gain + std::log(nested);
    // log((1 + e^g)^60 + e^w), and of it the part of 60 holes.
    const double all = 60 * (of_hole + std::log1p(std::exp(-of_hole)));
    const double evidence = all + std::log1p(std::exp(2 * gain - all));
    EXPECT_NEAR(sums.outcome.log_evidence, evidence, 1e-9 * evidence);
    EXPECT_EQ(sums.outcome.evidence_exactness, Exactness::exact);
    EXPECT_NEAR(sums.numbers[0][60], std::exp(60 * of_hole - evidence), 1e-9);
    EXPECT_NEAR(sums.numbers[0][59], std::exp(59 * of_hole + std::log(60) - evidence), 1e-9);
    EXPECT_NEAR(sums.outcome.posteriors[0][3], std::exp(gain + 0.02 - of_hole) / (1 + std::exp(-of_hole)), 1e-9);

    LabelingRequest request;
    request.k_best = 5;
    const FamilyOutcome best = best_with_families(problem, request, {});
    ASSERT_EQ(best.labelings.size(), 5U);
    EXPECT_EQ(best.labelings[0].instances[0].size(), 60U);
    EXPECT_NEAR(best.labelings[0].cost, -60 * (gain + 0.04), 1e-9);
    EXPECT_NEAR(best.labelings[1].cost, -60 * (gain + 0.04) + 0.01, 1e-9) << "the second best of one hole";
  }
}

TEST(FamilySums, NoMoreThanAreAllowed) {
  FamilyProblem problem = sixty_holes(10);
  problem.families[0].number_costs.assign(5, 0);
  const FamilyOutcome best = best_with_families(problem, {}, {}), sums = sum_with_families(problem, {}, {});
  EXPECT_EQ(best.labelings[0].instances[0].size(), 4U);
  ASSERT_EQ(sums.numbers[0].size(), 5U);
  EXPECT_GT(sums.numbers[0][4], 0.999);
}

/// Pairs of all with all are more than can be summed: what is left out is said, and nothing is called exact.
TEST(FamilySums, TooManyPairsAreSaidToBeApproximate) {
  FamilyProblem problem;
  LabelingVariable& leg = problem.problem.variables.emplace_back();
  leg.name = "leg";
  leg.costs.assign(61, -1);
  problem.families.push_back({0, std::vector<double>(61, 0)});
  LabelingConstraint& pair = problem.problem.constraints.emplace_back();
  pair.scope = {0, 0};
  pair.costs.assign(61 * 61, -0.01);
  const FamilyOutcome sums = sum_with_families(problem, {}, {});
  EXPECT_NE(sums.approximation.find("of the candidates of 'leg'"), std::string::npos) << sums.approximation;
  EXPECT_EQ(sums.outcome.evidence_exactness, Exactness::approximate);
  const FamilyOutcome best = best_with_families(problem, {}, {});
  EXPECT_FALSE(best.outcome.optimal);
}

TEST(FamilySums, TooManyCasesAreRefused) {
  FamilyProblem made = sixty_holes(1);
  LabelingProblem& problem = made.problem;
  LabelingConstraint constraint{"r1", {0}, {}, {}};
  for (Index s = 1; s <= 4; ++s) {
    problem.variables.push_back({.name = "s", .candidates = {}, .costs = std::vector<double>(20, 1)});
    LabelingConstraint& each = problem.constraints.emplace_back();
    each.scope = {0, s};
    for (std::size_t i = 0; i < problem.variables[0].costs.size() * 20; ++i)
      each.costs.push_back(static_cast<double>(i));
  }
  EXPECT_THROW(sum_with_families(made, {}, {}), std::runtime_error);
}

}  // namespace
}  // namespace toposcope
