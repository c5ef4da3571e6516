// SPDX-License-Identifier: BSD-3-Clause
#include "elimination_order.h"

#include <algorithm>
#include <random>

namespace toposcope::posterior {
namespace {

enum class Greed { fill, weighted_fill, table };

class GreedyOrder {
 public:
  GreedyOrder(const FactorGraph& graph, Watch& watch) : graph_(graph), watch_(watch) {
    linked_.assign(graph.variables(), std::vector<char>(graph.variables(), 0));
    for (const Factor& factor : graph.factors)
      for (const Index v : factor.scope)
        for (const Index w : factor.scope) linked_[v][w] = v != w;
  }

  /// Eliminates next the variable whose score is least. Ties go to a draw where there is a generator.
  EliminationPlan plan(Greed greed, std::mt19937_64* random, double limit) {
    std::vector<std::vector<char>> linked = linked_;
    std::vector<Index> left(graph_.variables());
    for (Index v = 0; v < left.size(); ++v) left[v] = v;
    EliminationPlan plan;
    plan.neighbors.resize(left.size());
    plan.entries = 0;
    std::vector<double> scores(left.size(), -1);  // negative: to be made anew
    while (!left.empty()) {
      double least = std::numeric_limits<double>::infinity();
      std::size_t ties = 0, chosen = 0;
      for (std::size_t i = 0; i < left.size(); ++i) {
        double& s = scores[left[i]];
        if (s < 0) s = score(greed, linked, left, left[i]);
        if (s < least || i == 0) {
          least = s;
          chosen = i;
          ties = 1;
        } else if (s == least && random && (*random)() % ++ties == 0) {
          chosen = i;
        }
      }
      const Index v = left[chosen];
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(chosen));
      std::vector<Index>& bound = plan.neighbors[v];
      double entries = static_cast<double>(graph_.domain(v));
      for (const Index w : left)
        if (linked[v][w]) {
          bound.push_back(w);
          entries *= static_cast<double>(graph_.domain(w));
        }
      plan.order.push_back(v);
      plan.entries += entries;
      if (!(plan.entries < limit)) return {};
      for (const Index w : bound)
        for (const Index u : bound) linked[w][u] = w != u;
      // The fill of a variable changes where a neighbour of it was bound.
      for (const Index w : left)
        if (linked[v][w] || std::any_of(bound.begin(), bound.end(), [&](Index u) { return linked[w][u]; }))
          scores[w] = -1;
    }
    return plan;
  }

 private:
  double score(Greed greed, const std::vector<std::vector<char>>& linked, const std::vector<Index>& left, Index v) {
    std::vector<Index>& near = near_;
    near.clear();
    double table = static_cast<double>(graph_.domain(v));
    for (const Index w : left)
      if (linked[v][w]) {
        near.push_back(w);
        table *= static_cast<double>(graph_.domain(w));
      }
    watch_.poll(left.size() + near.size() * near.size() / 2);
    if (greed == Greed::table) return table;
    double fill = 0;
    for (std::size_t i = 0; i < near.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!linked[near[i]][near[j]])
          fill += greed == Greed::fill ? 1.0 : static_cast<double>(graph_.domain(near[i]) * graph_.domain(near[j]));
    return fill;
  }

  const FactorGraph& graph_;
  Watch& watch_;
  std::vector<std::vector<char>> linked_;
  std::vector<Index> near_;
};

}  // namespace

EliminationPlan elimination_plan(const FactorGraph& graph, double limit, Watch& watch) {
  constexpr int repetitions = 8;
  GreedyOrder greedy(graph, watch);
  EliminationPlan best;
  std::mt19937_64 random(1);
  const auto attempt = [&](Greed greed, std::mt19937_64* generator) {
    EliminationPlan plan = greedy.plan(greed, generator, std::min(limit, best.entries));
    if (plan.entries < best.entries) best = std::move(plan);
  };
  for (const auto greed : {Greed::weighted_fill, Greed::fill, Greed::table}) attempt(greed, nullptr);
  for (int i = 0; i < repetitions; ++i)
    for (const auto greed : {Greed::weighted_fill, Greed::fill}) attempt(greed, &random);
  return best;
}

}  // namespace toposcope::posterior
