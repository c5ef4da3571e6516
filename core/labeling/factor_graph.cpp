// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/factor_graph.h"

#include <algorithm>
#include <map>
#include <utility>

#include "toposcope/geometry/large_array.h"

namespace toposcope::factors {
namespace {

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
    std::vector<std::vector<Index>> of(problem_.variables.size());  // constraints, by variable
    std::vector<Index> due(problem_.constraints.size());
    for (Index c = 0; c < due.size(); ++c) {
      due[c] = c;
      for (const Index v : problem_.constraints[c].scope) of[v].push_back(c);
    }
    std::vector<char> waits(due.size(), 1);
    for (std::size_t next = 0; next < due.size(); ++next) {
      waits[due[next]] = 0;
      const LabelingConstraint& constraint = problem_.constraints[due[next]];
      const std::vector<std::size_t> stride = strides(constraint);
      for (std::size_t k = 0; k < stride.size(); ++k) {
        for (const Index v : constraint.scope)
          if (graph_.values[v].empty()) return;
        std::vector<Index>& left = graph_.values[constraint.scope[k]];
        const std::size_t before = left.size();
        std::erase_if(left, [&](Index value) { return !supported(constraint, stride, k, value); });
        if (left.size() == before) continue;
        for (const Index other : of[constraint.scope[k]])
          if (!waits[other]) {
            waits[other] = 1;
            due.push_back(other);
          }
      }
    }
  }

  void add(const LabelingConstraint& constraint) {
    const std::size_t arity = constraint.scope.size();
    if (arity == 1) {
      const Index v = constraint.scope[0];
      for (std::size_t i = 0; i < graph_.domain(v); ++i) graph_.unary[v][i] += constraint.costs[graph_.values[v][i]];
      return;
    }
    if (std::all_of(constraint.scope.begin(), constraint.scope.end(),
                    [&](Index v) { return graph_.domain(v) == problem_.variables[v].domain(); })) {
      graph_.factors.push_back({constraint.scope, constraint.costs});
      return;
    }
    Factor factor{constraint.scope, {}};
    const std::vector<std::size_t> stride = strides(constraint);
    const std::vector<Index>& last = values(constraint, arity - 1);
    std::size_t rows = 1;
    for (std::size_t k = 0; k + 1 < arity; ++k) rows *= values(constraint, k).size();
    digits_.assign(arity, 0);
    for (; rows > 0; --rows) {
      std::size_t row = 0;
      for (std::size_t k = 0; k + 1 < arity; ++k) row += stride[k] * values(constraint, k)[digits_[k]];
      for (const Index value : last) factor.own.push_back(constraint.costs[row + value]);
      watch_.poll(2 * last.size());
      for (std::size_t k = arity - 1; k-- > 0;) {
        if (++digits_[k] < values(constraint, k).size()) break;
        digits_[k] = 0;
      }
    }
    factor.costs = factor.own;
    graph_.factors.push_back(std::move(factor));
  }

  /// Per pair of variables, ascending: factors over them, and over them in reverse.
  using Pairs = std::map<std::pair<Index, Index>, std::pair<std::vector<std::size_t>, std::vector<std::size_t>>>;

  /// Tables where none forbids already what the exclusions do: those of meshes do.
  void add_exclusions() {
    Pairs tables;
    std::vector<Index> choosing;
    for (Index v = 0; v < graph_.variables(); ++v)
      if (!problem_.variables[v].candidates.empty()) choosing.push_back(v);
    if (!choosing.empty())
      for (std::size_t f = 0; f < graph_.factors.size(); ++f)
        if (const std::vector<Index>& scope = graph_.factors[f].scope; scope.size() == 2) {
          auto& both = tables[std::minmax(scope[0], scope[1])];
          (scope[0] < scope[1] ? both.first : both.second).push_back(f);
        }
    for (std::size_t i = 0; i < choosing.size(); ++i)
      for (std::size_t j = i + 1; j < choosing.size(); ++j) add_exclusion(choosing[i], choosing[j], tables);
  }

  void add_exclusion(Index v, Index w, const Pairs& tables) {
    static const std::vector<std::size_t> none;
    const auto at = tables.find({v, w});
    const auto& same = at == tables.end() ? none : at->second.first;
    const auto& turned = at == tables.end() ? none : at->second.second;
    const std::size_t height = graph_.domain(v), width = graph_.domain(w);
    const auto forbids = [&](std::size_t entry) {
      return [&, entry](std::size_t f) { return !(graph_.factors[f].costs[entry] < forbidden); };
    };
    Factor exclusion{{v, w}, {}};
    for (std::size_t i = 0; i < height; ++i) {
      for (std::size_t j = 0; j < width; ++j) {
        if (!excluded(problem_, v, graph_.values[v][i], w, graph_.values[w][j]) ||
            std::any_of(same.begin(), same.end(), forbids(i * width + j)) ||
            std::any_of(turned.begin(), turned.end(), forbids(j * height + i)))
          continue;
        if (exclusion.own.empty()) exclusion.own.assign(height * width, 0.0);
        exclusion.own[i * width + j] = forbidden;
      }
      watch_.poll(4 * width);
    }
    if (exclusion.own.empty()) return;
    exclusion.costs = exclusion.own;
    graph_.factors.push_back(std::move(exclusion));
  }

  const LabelingProblem& problem_;
  Watch& watch_;
  FactorGraph graph_;
  std::vector<std::size_t> digits_;
};

}  // namespace

double entries(const FactorGraph& graph) {
  double sum = 0;
  for (const std::vector<double>& unary : graph.unary) sum += static_cast<double>(unary.size());
  for (const Factor& factor : graph.factors) sum += static_cast<double>(factor.costs.size());
  return sum;
}

double lower_bound(const FactorGraph& graph) {
  double bound = graph.constant;
  for (const std::vector<double>& unary : graph.unary) bound += *std::min_element(unary.begin(), unary.end());
  for (const Factor& factor : graph.factors) bound += *std::min_element(factor.costs.begin(), factor.costs.end());
  return bound;
}

void add_reordered(const FactorGraph& graph, const Factor& factor, const std::vector<Index>& scope,
                   std::vector<double>& table, Watch& watch) {
  const bool first = table.empty();
  if (first) reserve_large(table, factor.costs.size());
  if (first && scope == factor.scope) {
    table.assign(factor.costs.begin(), factor.costs.end());
    watch.poll(table.size());
    return;
  }
  if (first) table.resize(factor.costs.size(), 0.0);
  const std::size_t arity = scope.size(), width = graph.domain(factor.scope.back());
  std::vector<std::size_t> stride(arity), digits(arity, 0);  // in `table`, of the factor's k-th variable
  for (std::size_t k = 0; k < arity; ++k) {
    stride[k] = 1;
    for (std::size_t j = arity; scope[--j] != factor.scope[k];) stride[k] *= graph.domain(scope[j]);
  }
  std::size_t at = 0;
  for (std::size_t entry = 0; entry < factor.costs.size(); entry += width) {
    for (std::size_t i = 0; i < width; ++i) table[at + i * stride.back()] += factor.costs[entry + i];
    watch.poll(2 * width);
    for (std::size_t k = arity - 1; k-- > 0;) {
      at += stride[k];
      if (++digits[k] < graph.domain(factor.scope[k])) break;
      at -= stride[k] * digits[k];
      digits[k] = 0;
    }
  }
}

FactorGraph merged(const FactorGraph& graph, Watch& watch) {
  FactorGraph made{graph.values, graph.unary, {}, graph.constant, graph.impossible};
  std::map<std::vector<Index>, std::size_t> of;  // by the scope, ascending
  for (const Factor& factor : graph.factors) {
    std::vector<Index> scope = factor.scope;
    std::sort(scope.begin(), scope.end());
    const auto [at, first] = of.try_emplace(std::move(scope), made.factors.size());
    if (first) {
      made.factors.push_back({factor.scope, factor.costs});
      continue;
    }
    Factor& same = made.factors[at->second];
    if (same.own.empty()) same.own.assign(same.costs.begin(), same.costs.end());
    add_reordered(graph, factor, same.scope, same.own, watch);
    same.costs = same.own;
  }
  return made;
}

FactorGraph skeleton(const LabelingProblem& problem) {
  FactorGraph graph;
  graph.unary.resize(problem.variables.size());
  graph.values.resize(problem.variables.size());
  std::vector<Index> choosing;
  for (Index v = 0; v < problem.variables.size(); ++v) {
    const LabelingVariable& variable = problem.variables[v];
    for (Index value = 0; value < variable.domain(); ++value)
      if (variable.costs[value] < forbidden) graph.values[v].push_back(value);
    graph.unary[v].resize(graph.values[v].size());
    if (!variable.candidates.empty()) choosing.push_back(v);
  }
  for (const LabelingConstraint& constraint : problem.constraints)
    if (constraint.scope.size() > 1) graph.factors.push_back({constraint.scope, constraint.costs});
  const auto conflict = [&](Index v, Index w) {
    for (const Index a : problem.variables[v].candidates)
      for (const Index b : problem.variables[w].candidates)
        if (problem.conflict(a, b)) return true;
    return false;
  };
  for (std::size_t i = 0; i < choosing.size(); ++i)
    for (std::size_t j = i + 1; j < choosing.size(); ++j)
      if (conflict(choosing[i], choosing[j])) graph.factors.push_back({{choosing[i], choosing[j]}, {}});
  return graph;
}

FactorGraph factor_graph(const LabelingProblem& problem, Watch& watch) {
  return GraphBuilder(problem, watch).build();
}

}  // namespace toposcope::factors
