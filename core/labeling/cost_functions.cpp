// SPDX-License-Identifier: BSD-3-Clause
#include "cost_functions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr int most_decimals = 12, inexact_decimals = 9;
constexpr double most_magnitude = 1e15;

bool exclude_any(const LabelingProblem& problem, Index v, Index w) {
  for (Index a = 0; a < problem.variables[v].domain(); ++a)
    for (Index b = 0; b < problem.variables[w].domain(); ++b)
      if (excluded(problem, v, a, w, b)) return true;
  return false;
}

// To the rounding of the few operations that made the cost: 3 times 0.7 has one digit.
bool is_decimal(double cost, int digits) {
  constexpr double rounding = 1e-15;
  const double scaled = cost * power_of_ten(digits);
  return std::abs(scaled) < 9e15 && std::abs(std::round(scaled) - scaled) <= rounding * std::abs(scaled);
}

}  // namespace

std::vector<CostFunction> cost_functions(const LabelingProblem& problem) {
  std::vector<CostFunction> functions;
  for (Index v = 0; v < problem.variables.size(); ++v) {
    const std::vector<double>& costs = problem.variables[v].costs;
    if (std::any_of(costs.begin(), costs.end(), [](double cost) { return cost != 0; }))
      functions.push_back({"cost_" + problem.variables[v].name, {v}, &costs, false});
  }
  std::map<std::pair<Index, Index>, std::size_t> binary;  // the first of each pair
  for (const LabelingConstraint& constraint : problem.constraints) {
    if (constraint.scope.size() == 2)
      binary.emplace(std::minmax(constraint.scope[0], constraint.scope[1]), functions.size());
    functions.push_back({constraint.name, constraint.scope, &constraint.costs, false});
  }
  if (problem.candidate_count == 0) return functions;
  for (Index v = 0; v < problem.variables.size(); ++v)
    for (Index w = v + 1; w < problem.variables.size(); ++w) {
      if (!exclude_any(problem, v, w)) continue;
      if (const auto found = binary.find({v, w}); found != binary.end())
        functions[found->second].exclusions = true;
      else
        functions.push_back({"exclusion_" + std::to_string(v) + "_" + std::to_string(w), {v, w}, nullptr, true});
    }
  return functions;
}

void fill_table(const LabelingProblem& problem, const CostFunction& function, std::vector<double>& table) {
  if (function.costs) {
    table = *function.costs;
  } else {
    std::size_t size = 1;
    for (const Index v : function.scope) size *= problem.variables[v].domain();
    table.assign(size, 0);
  }
  if (!function.exclusions) return;
  const Index v = function.scope[0], w = function.scope[1], columns = problem.variables[w].domain();
  for (Index a = 0; a < problem.variables[v].domain(); ++a)
    for (Index b = 0; b < columns; ++b)
      if (excluded(problem, v, a, w, b)) table[std::size_t{a} * columns + b] = forbidden;
}

CostRange finite_range(const std::vector<double>& table) {
  double least = forbidden, greatest = -forbidden;
  for (const double cost : table)
    if (cost < forbidden) {
      least = std::min(least, cost);
      greatest = std::max(greatest, cost);
    }
  return least < forbidden ? CostRange{least, greatest} : CostRange{};
}

double frequent_entry(const std::vector<double>& table) {
  double candidate = 0;
  std::size_t votes = 0;
  for (const double cost : table) {
    if (votes == 0) candidate = cost;
    votes += cost == candidate ? 1 : static_cast<std::size_t>(-1);
  }
  return candidate;
}

Decimals decimals_of(const LabelingProblem& problem, double magnitude) {
  if (!(magnitude < most_magnitude))
    throw std::invalid_argument("the costs sum up to " + std::to_string(magnitude) +
                                ", which is too large for 15 digits; scale them, or write .json");
  Decimals decimals;
  const auto include = [&](double cost) {
    if (!std::isfinite(cost)) return;
    while (decimals.digits <= most_decimals && !is_decimal(cost, decimals.digits)) ++decimals.digits;
  };
  include(problem.constant);
  for (const LabelingVariable& variable : problem.variables)
    for (const double cost : variable.costs) include(cost);
  for (const LabelingConstraint& constraint : problem.constraints)
    for (const double cost : constraint.costs) include(cost);
  decimals.exact = decimals.digits <= most_decimals && magnitude * power_of_ten(decimals.digits) < most_magnitude;
  if (!decimals.exact) decimals.digits = inexact_decimals;
  while (magnitude * power_of_ten(decimals.digits) >= most_magnitude) --decimals.digits;
  return decimals;
}

double power_of_ten(int exponent) {
  double power = 1;
  for (; exponent > 0; --exponent) power *= 10;
  return power;
}

}  // namespace toposcope
