// SPDX-License-Identifier: BSD-3-Clause
#include "support/planted_problems.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "support/labeling_problems.h"
#include "support/random.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::test {
namespace {

constexpr double side = 100;          // of the cube in which the candidates lie
constexpr double tolerance = 2;       // of a relationship
constexpr double exception = 0.01;    // probability that a relationship fails all the same
constexpr double clutter = 1 / side;  // density of an unrelated pair's residual

using Place = std::array<double, 3>;

double distance(const Place& a, const Place& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Minus the log likelihood ratio of a normal residual against clutter (docs/theory/probabilities.md).
double relation_cost(double residual) {
  const double z = residual / tolerance;
  return -std::log(exception + (1 - exception) * std::exp(-z * z / 2) / (tolerance * std::sqrt(2 * pi)) / clutter);
}

}  // namespace

LabelingProblem planted_problem(const PlantedKind& kind, std::uint64_t seed, std::vector<Index>* truth) {
  Random random(seed);
  LabelingProblem problem;
  problem.name = std::to_string(kind.features) + "x" + std::to_string(kind.candidates);
  problem.candidate_count = kind.candidates + kind.candidates / 2 + kind.features;
  for (Index c = 0; c < problem.candidate_count; ++c) set_conflict(problem, c, c);
  std::vector<Place> places(problem.candidate_count);
  for (Place& place : places)
    for (double& x : place) x = random.uniform(0, side);

  if (truth) truth->clear();
  for (Index f = 0; f < kind.features; ++f) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "f" + std::to_string(f);
    variable.detectability = 0.9;
    // The true place, the f-th of the pool, among others drawn without repetition.
    std::vector<Index> pool;
    for (Index c = 0; c < problem.candidate_count; ++c)
      if (c != f) pool.push_back(c);
    for (Index k = 0; k + 1 < kind.candidates; ++k) std::swap(pool[k], pool[k + random.below(pool.size() - k)]);
    pool.resize(kind.candidates - 1);
    const Index at = random.below(kind.candidates);
    pool.insert(pool.begin() + at, f);
    variable.candidates = pool;
    variable.costs.push_back(3);
    for (Index k = 0; k < kind.candidates; ++k)
      variable.costs.push_back(random.uniform(-3, 3) - (kind.structured && k == at ? 1.5 : 0));
    if (truth) truth->push_back(at + 1);
  }
  for (Index f = 0; f < kind.features; ++f)
    for (Index g = f + 1; g < kind.features; ++g) {
      if (!random.chance(kind.density)) continue;
      LabelingConstraint constraint = empty_constraint(problem, {f, g});
      constraint.name = "d" + std::to_string(f) + "-" + std::to_string(g);
      constraint.violations.clear();
      const double expected = distance(places[f], places[g]) + tolerance * random.normal();
      for (Index a = 1; a <= kind.candidates; ++a)
        for (Index b = 1; b <= kind.candidates; ++b)
          constraint.costs[a * (kind.candidates + 1) + b] =
              kind.structured ? relation_cost(distance(places[problem.variables[f].candidates[a - 1]],
                                                       places[problem.variables[g].candidates[b - 1]]) -
                                              expected)
                              : random.uniform(-2, 4);
      problem.constraints.push_back(std::move(constraint));
    }
  return problem;
}

}  // namespace toposcope::test
