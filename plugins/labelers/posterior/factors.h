// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A labelling problem as a factor graph over the values that can still occur: unary costs, and tables over two or more
// variables. Exclusions are tables over those pairs of variables whose candidates conflict.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "toposcope/labeling_tools.h"
#include "watch.h"

namespace toposcope::posterior {

/// Costs over two or more variables, row-major, the last of the scope fastest.
struct Factor {
  std::vector<Index> scope;  ///< ascending
  std::vector<double> costs;
};

struct FactorGraph {
  std::vector<std::vector<Index>> values;  ///< per variable: the problem's values that are left, ascending
  std::vector<std::vector<double>> unary;  ///< per variable, per value left: finite
  std::vector<Factor> factors;
  double constant = 0;
  bool impossible = false;  ///< a variable has no value left: no labelling has a finite cost

  Index variables() const { return static_cast<Index>(values.size()); }
  std::size_t domain(Index variable) const { return values[variable].size(); }
};

namespace detail {

/// Visits the entries of a constraint's table over the values left: `visit(entry, digits)`, digits being positions
/// among these. The order is that of a table over the values left.
template <class Visit>
void each_entry(const LabelingProblem& problem, const LabelingConstraint& constraint,
                const std::vector<std::vector<Index>>& values, Watch& watch, const Visit& visit) {
  const std::size_t arity = constraint.scope.size();
  std::vector<std::size_t> stride(arity, 1), digits(arity, 0);
  for (std::size_t k = arity; k-- > 1;) stride[k - 1] = stride[k] * problem.variables[constraint.scope[k]].domain();
  for (const Index v : constraint.scope)
    if (values[v].empty()) return;
  const std::vector<Index>& last = values[constraint.scope.back()];
  for (;;) {
    std::size_t row = 0;
    for (std::size_t k = 0; k + 1 < arity; ++k) row += stride[k] * values[constraint.scope[k]][digits[k]];
    for (std::size_t& i = digits.back() = 0; i < last.size(); ++i) visit(row + last[i], digits);
    watch.poll(2 * last.size());
    std::size_t k = arity - 1;
    while (k-- > 0) {
      if (++digits[k] < values[constraint.scope[k]].size()) break;
      digits[k] = 0;
    }
    if (k == static_cast<std::size_t>(-1)) return;
  }
}

/// Strikes the values that no entry of finite cost of some constraint has (generalised arc consistency).
inline void strike_unsupported(const LabelingProblem& problem, std::vector<std::vector<Index>>& values, Watch& watch) {
  std::vector<bool> due(problem.constraints.size(), true);
  for (bool fallen = true; fallen;) {
    fallen = false;
    for (Index c = 0; c < problem.constraints.size(); ++c) {
      if (!due[c]) continue;
      due[c] = false;
      const LabelingConstraint& constraint = problem.constraints[c];
      std::vector<std::vector<char>> supported;
      for (const Index v : constraint.scope) supported.emplace_back(values[v].size(), 0);
      each_entry(problem, constraint, values, watch, [&](std::size_t entry, const std::vector<std::size_t>& digits) {
        if (constraint.costs[entry] < forbidden)
          for (std::size_t k = 0; k < digits.size(); ++k) supported[k][digits[k]] = 1;
      });
      for (std::size_t k = 0; k < supported.size(); ++k) {
        const Index v = constraint.scope[k];
        std::vector<Index> left;
        for (std::size_t i = 0; i < values[v].size(); ++i)
          if (supported[k][i]) left.push_back(values[v][i]);
        if (left.size() == values[v].size()) continue;
        values[v] = std::move(left);
        fallen = true;
        for (Index other = 0; other < problem.constraints.size(); ++other) {
          const auto& scope = problem.constraints[other].scope;
          if (std::find(scope.begin(), scope.end(), v) != scope.end()) due[other] = true;
        }
      }
    }
  }
}

}  // namespace detail

/// \throw OutOfTime
inline FactorGraph factor_graph(const LabelingProblem& problem, Watch& watch) {
  FactorGraph graph;
  graph.constant = problem.constant;
  graph.values.resize(problem.variables.size());
  for (Index v = 0; v < problem.variables.size(); ++v)
    for (Index value = 0; value < problem.variables[v].domain(); ++value)
      if (problem.variables[v].costs[value] < forbidden) graph.values[v].push_back(value);
  detail::strike_unsupported(problem, graph.values, watch);
  for (Index v = 0; v < problem.variables.size(); ++v) {
    graph.impossible = graph.impossible || graph.values[v].empty();
    graph.unary.emplace_back();
    for (const Index value : graph.values[v]) graph.unary[v].push_back(problem.variables[v].costs[value]);
  }
  if (graph.impossible) return graph;

  const auto factor_over = [&](const std::vector<Index>& scope) -> Factor& {
    for (Factor& factor : graph.factors)
      if (factor.scope == scope) return factor;
    std::size_t entries = 1;
    for (const Index v : scope) entries *= graph.domain(v);
    graph.factors.push_back({scope, std::vector<double>(entries, 0.0)});
    return graph.factors.back();
  };
  for (const LabelingConstraint& constraint : problem.constraints) {
    std::vector<Index> scope = constraint.scope;
    std::sort(scope.begin(), scope.end());
    if (scope.size() == 1) {
      for (std::size_t i = 0; i < graph.domain(scope[0]); ++i)
        graph.unary[scope[0]][i] += constraint.costs[graph.values[scope[0]][i]];
      continue;
    }
    Factor& factor = factor_over(scope);
    std::vector<std::size_t> stride(scope.size(), 1);  // in the factor, of the constraint's k-th variable
    for (std::size_t k = 0; k < scope.size(); ++k)
      for (const Index v : scope)
        if (v > constraint.scope[k]) stride[k] *= graph.domain(v);
    detail::each_entry(problem, constraint, graph.values, watch,
                       [&](std::size_t entry, const std::vector<std::size_t>& digits) {
                         std::size_t at = 0;
                         for (std::size_t k = 0; k < digits.size(); ++k) at += stride[k] * digits[k];
                         factor.costs[at] += constraint.costs[entry];
                       });
  }
  for (Index v = 0; v < graph.variables(); ++v)
    for (Index w = v + 1; w < graph.variables(); ++w) {
      if (problem.variables[v].candidates.empty() || problem.variables[w].candidates.empty()) continue;
      Factor* factor = nullptr;
      for (std::size_t i = 0; i < graph.domain(v); ++i) {
        for (std::size_t j = 0; j < graph.domain(w); ++j)
          if (excluded(problem, v, graph.values[v][i], w, graph.values[w][j])) {
            if (!factor) factor = &factor_over({v, w});
            factor->costs[i * graph.domain(w) + j] = forbidden;
          }
        watch.poll(4 * graph.domain(w));
      }
    }
  // A factor without information binds nothing.
  std::erase_if(graph.factors, [](const Factor& factor) {
    return std::all_of(factor.costs.begin(), factor.costs.end(), [](double cost) { return cost == 0; });
  });
  return graph;
}

}  // namespace toposcope::posterior
