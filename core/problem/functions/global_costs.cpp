// SPDX-License-Identifier: BSD-3-Clause
#include "functions/global_costs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace toposcope {
namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();
}

RegularCost::RegularCost(Automaton automaton, double substitution, bool edit)
    : automaton_(std::move(automaton)),
      substitution_(substitution),
      edit_(edit),
      here_(automaton_.states, infinite),
      next_(automaton_.states, infinite) {}

void RegularCost::insert(std::vector<double>& states) const {
  for (bool changed = edit_; changed;) {
    changed = false;
    for (const Transition& step : automaton_.transitions)
      if (states[step.from] + substitution_ < states[step.to]) {
        states[step.to] = states[step.from] + substitution_;
        changed = true;
      }
  }
}

double RegularCost::operator()(std::span<const Index> values) {
  std::fill(here_.begin(), here_.end(), infinite);
  for (const Transition& start : automaton_.starts) here_[start.from] = std::min(here_[start.from], start.cost);
  insert(here_);
  for (const Index value : values) {
    std::fill(next_.begin(), next_.end(), infinite);
    for (const Transition& step : automaton_.transitions) {
      const double cost = here_[step.from] + step.cost + (step.symbol == value ? 0 : substitution_);
      next_[step.to] = std::min(next_[step.to], cost);
    }
    if (edit_)
      for (Index state = 0; state < automaton_.states; ++state)
        next_[state] = std::min(next_[state], here_[state] + substitution_);
    insert(next_);
    std::swap(here_, next_);
  }
  double least = infinite;
  for (const Transition& end : automaton_.ends) least = std::min(least, here_[end.from] + end.cost);
  return least;
}

double GrammarCost::operator()(std::span<const Index> values) {
  const std::size_t n = values.size(), symbols = grammar_.symbols;
  table_.assign(n * n * symbols, infinite);
  const auto cell = [&](std::size_t first, std::size_t length, Index symbol) -> double& {
    return table_[(first * n + length - 1) * symbols + symbol];
  };
  for (std::size_t i = 0; i < n; ++i)
    for (const Grammar::Terminal& rule : grammar_.terminals) {
      double& least = cell(i, 1, rule.from);
      least = std::min(least, rule.cost + (rule.symbol == values[i] ? 0 : substitution_));
    }
  for (std::size_t length = 2; length <= n; ++length)
    for (std::size_t i = 0; i + length <= n; ++i)
      for (const Grammar::Production& rule : grammar_.productions)
        for (std::size_t left = 1; left < length; ++left) {
          double& least = cell(i, length, rule.from);
          least = std::min(least, cell(i, left, rule.left) + cell(i + left, length - left, rule.right) + rule.cost);
        }
  return n == 0 ? infinite : cell(0, n, grammar_.start);
}

double violation_cost(Measure measure, double cost, double gap) {
  if (gap == 0) return 0;
  return measure == Measure::hard ? cost : measure == Measure::linear ? cost * gap : cost * gap * gap;
}

double comparison_gap(const std::string& comparator, double value, double right) {
  if (comparator == "==") return std::abs(value - right);
  if (comparator == "!=") return value == right ? 1 : 0;
  if (comparator == "<") return std::max(0.0, value - right + 1);
  if (comparator == "<=") return std::max(0.0, value - right);
  if (comparator == ">") return std::max(0.0, right - value + 1);
  return std::max(0.0, right - value);
}

const std::vector<Index>& ValueCounts::of(std::span<const Index> values) {
  std::fill(counts_.begin(), counts_.end(), 0);
  for (const Index value : values) ++counts_[value];
  return counts_;
}

bool is_spanning_tree(std::span<const Index> parents) {
  std::size_t roots = 0;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    roots += parents[i] == i ? 1 : 0;
    Index at = static_cast<Index>(i);
    for (std::size_t step = 0; step < parents.size() && parents[at] != at; ++step) at = parents[at];
    if (parents[at] != at) return false;
  }
  return roots == 1;
}

}  // namespace toposcope
