// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A labelling problem as a factor graph over the values that can still occur: unary costs, and tables over two or more
// variables. Exclusions are tables over those pairs of variables whose candidates conflict.

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "toposcope/labeling_tools.h"
#include "toposcope/large_array.h"
#include "watch.h"

namespace toposcope::posterior {

/// Costs over two or more variables, row-major, the last of the scope fastest.
struct Factor {
  std::vector<Index> scope;       ///< ascending
  std::span<const double> costs;  ///< `own`, or a table of the problem's
  std::vector<double> own = {};
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

/// Makes a problem's factor graph. Large tables are read in place where nothing is to be changed in them.
class GraphBuilder {
 public:
  GraphBuilder(const LabelingProblem& problem, Watch& watch) : problem_(problem), watch_(watch) {}

  FactorGraph build() {
    graph_.constant = problem_.constant;
    graph_.values.resize(problem_.variables.size());
    for (Index v = 0; v < problem_.variables.size(); ++v)
      for (Index value = 0; value < problem_.variables[v].domain(); ++value)
        if (problem_.variables[v].costs[value] < forbidden) graph_.values[v].push_back(value);
    strike_unsupported();
    for (Index v = 0; v < problem_.variables.size(); ++v) {
      graph_.impossible = graph_.impossible || graph_.values[v].empty();
      graph_.unary.emplace_back();
      for (const Index value : graph_.values[v]) graph_.unary[v].push_back(problem_.variables[v].costs[value]);
    }
    if (graph_.impossible) return std::move(graph_);
    for (const LabelingConstraint& constraint : problem_.constraints) add(constraint);
    add_exclusions();
    // A factor without information binds nothing.
    std::erase_if(graph_.factors, [](const Factor& factor) {
      return std::all_of(factor.costs.begin(), factor.costs.end(), [](double cost) { return cost == 0; });
    });
    return std::move(graph_);
  }

 private:
  const std::vector<Index>& values(const LabelingConstraint& constraint, std::size_t k) const {
    return graph_.values[constraint.scope[k]];
  }

  std::vector<std::size_t> strides(const LabelingConstraint& constraint) const {
    std::vector<std::size_t> stride(constraint.scope.size(), 1);
    for (std::size_t k = stride.size(); k-- > 1;)
      stride[k - 1] = stride[k] * problem_.variables[constraint.scope[k]].domain();
    return stride;
  }

  /// True where the constraint has an entry of finite cost with the value at place k of its scope.
  bool supported(const LabelingConstraint& constraint, const std::vector<std::size_t>& stride, std::size_t k,
                 Index value) {
    digits_.assign(stride.size(), 0);
    for (;;) {
      std::size_t entry = value * stride[k];
      for (std::size_t j = 0; j < stride.size(); ++j)
        if (j != k) entry += stride[j] * values(constraint, j)[digits_[j]];
      if (constraint.costs[entry] < forbidden) return true;
      watch_.poll(stride.size());
      std::size_t j = stride.size();
      while (j-- > 0) {
        if (j == k) continue;
        if (++digits_[j] < values(constraint, j).size()) break;
        digits_[j] = 0;
      }
      if (j == static_cast<std::size_t>(-1)) return false;
    }
  }

  /// Strikes the values that no entry of finite cost of some constraint has (generalised arc consistency).
  void strike_unsupported() {
    std::vector<bool> due(problem_.constraints.size(), true);
    for (bool fallen = true; fallen;) {
      fallen = false;
      for (Index c = 0; c < problem_.constraints.size(); ++c) {
        if (!due[c]) continue;
        due[c] = false;
        const LabelingConstraint& constraint = problem_.constraints[c];
        const std::vector<std::size_t> stride = strides(constraint);
        for (std::size_t k = 0; k < stride.size(); ++k) {
          for (const Index v : constraint.scope)
            if (graph_.values[v].empty()) return;
          std::vector<Index>& left = graph_.values[constraint.scope[k]];
          const std::size_t before = left.size();
          std::erase_if(left, [&](Index value) { return !supported(constraint, stride, k, value); });
          if (left.size() == before) continue;
          fallen = true;
          for (Index other = 0; other < problem_.constraints.size(); ++other) {
            const auto& scope = problem_.constraints[other].scope;
            if (std::find(scope.begin(), scope.end(), constraint.scope[k]) != scope.end()) due[other] = true;
          }
        }
      }
    }
  }

  Factor* find(const std::vector<Index>& scope) {
    for (Factor& factor : graph_.factors)
      if (factor.scope == scope) return &factor;
    return nullptr;
  }

  /// The factor over a scope, with a table of its own.
  Factor& own_factor(const std::vector<Index>& scope) {
    Factor* factor = find(scope);
    if (!factor) {
      std::size_t entries = 1;
      for (const Index v : scope) entries *= graph_.domain(v);
      graph_.factors.push_back({scope, {}, large_array<double>(entries, 0.0)});
      factor = &graph_.factors.back();
    } else if (factor->own.empty()) {
      reserve_large(factor->own, factor->costs.size());
      factor->own.assign(factor->costs.begin(), factor->costs.end());
    }
    factor->costs = factor->own;
    return *factor;
  }

  void add(const LabelingConstraint& constraint) {
    std::vector<Index> scope = constraint.scope;
    std::sort(scope.begin(), scope.end());
    const std::size_t arity = scope.size();
    if (arity == 1) {
      for (std::size_t i = 0; i < graph_.domain(scope[0]); ++i)
        graph_.unary[scope[0]][i] += constraint.costs[graph_.values[scope[0]][i]];
      return;
    }
    const bool whole = std::all_of(scope.begin(), scope.end(),
                                   [&](Index v) { return graph_.domain(v) == problem_.variables[v].domain(); });
    if (whole && scope == constraint.scope && !find(scope)) {
      graph_.factors.push_back({scope, constraint.costs});
      return;
    }
    Factor& factor = own_factor(scope);
    const std::vector<std::size_t> from = strides(constraint);
    std::vector<std::size_t> to(arity, 1);  // in the factor, of the constraint's k-th variable
    for (std::size_t k = 0; k < arity; ++k)
      for (const Index v : scope)
        if (v > constraint.scope[k]) to[k] *= graph_.domain(v);
    digits_.assign(arity, 0);
    const std::vector<Index>& last = values(constraint, arity - 1);
    const std::size_t rows = factor.own.size() / last.size();
    for (std::size_t row = 0; row < rows; ++row) {
      std::size_t source = 0, target = 0;
      for (std::size_t k = 0; k + 1 < arity; ++k) {
        source += from[k] * values(constraint, k)[digits_[k]];
        target += to[k] * digits_[k];
      }
      for (std::size_t i = 0; i < last.size(); ++i)
        factor.own[target + i * to.back()] += constraint.costs[source + last[i]];
      watch_.poll(2 * last.size());
      for (std::size_t k = arity - 1; k-- > 0;) {
        if (++digits_[k] < values(constraint, k).size()) break;
        digits_[k] = 0;
      }
    }
  }

  void add_exclusions() {
    for (Index v = 0; v < graph_.variables(); ++v)
      for (Index w = v + 1; w < graph_.variables(); ++w) {
        if (problem_.variables[v].candidates.empty() || problem_.variables[w].candidates.empty()) continue;
        const std::size_t width = graph_.domain(w);
        Factor* factor = find({v, w});
        for (std::size_t i = 0; i < graph_.domain(v); ++i) {
          for (std::size_t j = 0; j < width; ++j) {
            if (!excluded(problem_, v, graph_.values[v][i], w, graph_.values[w][j])) continue;
            if (factor && !(factor->costs[i * width + j] < forbidden)) continue;
            factor = &own_factor({v, w});
            factor->own[i * width + j] = forbidden;
          }
          watch_.poll(4 * width);
        }
      }
  }

  const LabelingProblem& problem_;
  Watch& watch_;
  FactorGraph graph_;
  std::vector<std::size_t> digits_;
};

}  // namespace detail

/// \pre the problem outlives the graph \throw OutOfTime
inline FactorGraph factor_graph(const LabelingProblem& problem, Watch& watch) {
  return detail::GraphBuilder(problem, watch).build();
}

}  // namespace toposcope::posterior
