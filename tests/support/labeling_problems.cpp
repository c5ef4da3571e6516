// SPDX-License-Identifier: BSD-3-Clause
#include "support/labeling_problems.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "support/random.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::test {

RandomKind random_kind(std::uint64_t seed) {
  Random random(seed ^ 0x9e3779b97f4a7c15ULL);
  RandomKind kind;
  kind.variables = 1 + static_cast<int>(random.below(6));
  kind.domain = 2 + static_cast<int>(random.below(4));
  kind.arity = 1 + static_cast<int>(random.below(4));
  kind.constraints = static_cast<int>(random.below(9));
  kind.ties = random.chance(0.4);
  kind.optional = std::array<double, 3>{1, 1, 0.5}[random.below(3)];
  if (random.chance(0.2)) kind.forbidden_entries = 0.5;
  return kind;
}

LabelingProblem random_problem(const RandomKind& kind, std::uint64_t seed) {
  Random random(seed);
  const auto cost = [&](double low, double high) {
    const double x = random.uniform(low, high);
    return kind.ties ? std::round(x * 4) / 4 : x;
  };
  LabelingProblem problem;
  problem.name = "random";
  problem.constant = cost(-2, 2);
  problem.candidate_count = static_cast<Index>(kind.domain + 3);
  for (int i = 0; i < kind.variables; ++i) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "f" + std::to_string(i);
    variable.detectability = random.uniform(0.1, 1);
    variable.optional = random.chance(kind.optional);
    const bool exclusive = random.chance(0.8);
    const Index values = (variable.optional ? 0 : 1) + random.below(static_cast<std::size_t>(kind.domain));
    if (variable.optional) variable.costs.push_back(cost(0, 4));
    for (Index k = 0; k < values; ++k) {
      if (exclusive) variable.candidates.push_back(random.below(problem.candidate_count));
      variable.costs.push_back(random.chance(kind.forbidden_unary) ? forbidden : cost(-4, 4));
    }
  }
  for (Index a = 0; a < problem.candidate_count; ++a) {
    set_conflict(problem, a, a);
    if (random.chance(0.33)) set_conflict(problem, a, random.below(problem.candidate_count));
  }
  for (int c = 0; c < kind.constraints; ++c) {
    std::vector<Index> scope(problem.variables.size());
    for (Index v = 0; v < scope.size(); ++v) scope[v] = v;
    for (Index v = 0; v < scope.size(); ++v) std::swap(scope[v], scope[v + random.below(scope.size() - v)]);
    scope.resize(std::min<std::size_t>(scope.size(), 1 + random.below(static_cast<std::size_t>(kind.arity))));
    LabelingConstraint& constraint = problem.constraints.emplace_back(empty_constraint(problem, scope));
    constraint.name = "r" + std::to_string(c);
    const bool crisp_form = random.chance(0.7);
    std::vector<Index> digits(scope.size(), 0);
    std::size_t entry = 0;
    do {
      bool missing = false;
      for (std::size_t k = 0; k < scope.size(); ++k) missing |= problem.variables[scope[k]].missing(digits[k]);
      if (!missing) {
        const bool no = random.chance(kind.forbidden_entries);
        constraint.costs[entry] = no ? forbidden : cost(-3, 5);
        constraint.violations[entry] = static_cast<float>(no ? forbidden : random.uniform(0, 1.3));
      }
      ++entry;
    } while (next_entry(problem, constraint, digits));
    if (!crisp_form) constraint.violations.clear();
  }
  return problem;
}

std::vector<Labeling> all_labelings(const LabelingProblem& problem) {
  std::vector<Labeling> all;
  Labeling now{std::vector<Index>(problem.variables.size(), 0), 0};
  for (bool more = true; more;) {
    now.cost = cost_of(problem, now.values);
    if (now.cost < forbidden) all.push_back(now);
    more = false;
    for (std::size_t i = now.values.size(); i-- > 0 && !more;) {
      more = ++now.values[i] < problem.variables[i].domain();
      if (!more) now.values[i] = 0;
    }
  }
  std::sort(all.begin(), all.end(), [](const Labeling& a, const Labeling& b) {
    return std::tie(a.cost, a.values) < std::tie(b.cost, b.values);
  });
  return all;
}

BruteForce sums(const LabelingProblem& problem, const std::vector<Labeling>& all) {
  BruteForce made;
  for (const LabelingVariable& variable : problem.variables) made.posteriors.emplace_back(variable.domain(), 0.0);
  double total = 0;
  for (const Labeling& labeling : all) {
    const double weight = std::exp(all.front().cost - labeling.cost);
    total += weight;
    for (Index v = 0; v < labeling.values.size(); ++v) made.posteriors[v][labeling.values[v]] += weight;
  }
  for (auto& posterior : made.posteriors)
    for (double& p : posterior) p = total > 0 ? p / total : 0;
  made.log_evidence = all.empty() ? -forbidden : std::log(total) - all.front().cost;
  return made;
}

LabelingProblem queens(Index n) {
  LabelingProblem problem;
  problem.name = std::to_string(n) + "-queens";
  for (Index row = 0; row < n; ++row) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "row" + std::to_string(row);
    variable.optional = false;
    variable.costs.assign(n, 0);
  }
  for (Index r = 0; r < n; ++r)
    for (Index s = r + 1; s < n; ++s) {
      LabelingConstraint constraint = empty_constraint(problem, {r, s});
      constraint.name = "rows " + std::to_string(r) + " and " + std::to_string(s);
      constraint.violations.clear();
      for (Index a = 0; a < n; ++a)
        for (Index b = 0; b < n; ++b)
          if (a == b || (a > b ? a - b : b - a) == s - r) constraint.costs[a * n + b] = forbidden;
      problem.constraints.push_back(std::move(constraint));
    }
  return problem;
}

}  // namespace toposcope::test
