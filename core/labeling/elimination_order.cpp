// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <queue>
#include <random>

#include "toposcope/labeling/elimination.h"

namespace toposcope::factors {
namespace {

enum class Greed { fill, weighted_fill, table };

constexpr double unreachable = std::numeric_limits<double>::infinity();

/// The links of a graph while its variables go one by one. A variable of one value binds nothing and has none.
class Links {
 public:
  explicit Links(const FactorGraph& graph)
      : of_(graph.variables()), living_(graph.variables(), 0), gone_(graph.variables(), 0) {
    for (const Factor& factor : graph.factors)
      for (const Index v : factor.scope)
        for (const Index w : factor.scope)
          if (w != v && graph.domain(v) > 1 && graph.domain(w) > 1) of_[v].push_back(w);
    for (Index v = 0; v < graph.variables(); ++v) {
      std::sort(of_[v].begin(), of_[v].end());
      of_[v].erase(std::unique(of_[v].begin(), of_[v].end()), of_[v].end());
      living_[v] = of_[v].size();
    }
  }

  std::size_t count(Index v) const { return living_[v]; }

  /// Those still there, ascending.
  const std::vector<Index>& of(Index v) {
    std::vector<Index>& all = of_[v];
    if (all.size() > living_[v]) std::erase_if(all, [&](Index w) { return gone_[w] != 0; });
    return all;
  }

  bool linked(Index v, Index w) const {
    const std::vector<Index>& shorter = of_[v].size() < of_[w].size() ? of_[v] : of_[w];
    return std::binary_search(shorter.begin(), shorter.end(), of_[v].size() < of_[w].size() ? w : v);
  }

  void link(Index v, Index w) {
    for (const auto& [a, b] : {std::pair{v, w}, std::pair{w, v}}) {
      of_[a].insert(std::lower_bound(of_[a].begin(), of_[a].end(), b), b);
      ++living_[a];
    }
  }

  void remove(Index v) {
    gone_[v] = 1;
    for (const Index w : of(v)) --living_[w];
  }

 private:
  std::vector<std::vector<Index>> of_;
  std::vector<std::size_t> living_;
  std::vector<char> gone_;
};

/// Eliminates next the variable whose score is least. Ties go to the first, or by lot where there is a generator.
class GreedyOrder {
 public:
  GreedyOrder(const FactorGraph& graph, const Links& links, Greed greed, double limit, Watch& watch)
      : graph_(graph),
        links_(links),
        greed_(greed),
        limit_(limit),
        most_(static_cast<std::size_t>(std::log2(std::max(2.0, limit))) + 1),
        watch_(watch),
        version_(graph.variables(), 0) {}

  EliminationPlan plan(std::mt19937_64* random) {
    random_ = random;
    EliminationPlan plan;
    plan.neighbors.resize(graph_.variables());
    plan.entries = 0;
    for (Index v = 0; v < graph_.variables(); ++v) rescore(v);
    while (plan.order.size() < graph_.variables()) {
      while (!queue_.empty() && queue_.top().version != version_[queue_.top().variable]) queue_.pop();
      if (queue_.empty()) return {};
      const Index v = queue_.top().variable;
      queue_.pop();
      ++version_[v];
      std::vector<Index>& bound = plan.neighbors[v];
      bound = links_.of(v);
      plan.entries += table(v);
      if (!(plan.entries < limit_)) return {};
      plan.order.push_back(v);
      links_.remove(v);
      bind(bound);
    }
    return plan;
  }

 private:
  struct Scored {
    double score;
    std::uint64_t tie;
    Index variable;
    std::uint32_t version;
    bool operator<(const Scored& other) const { return score != other.score ? score > other.score : tie > other.tie; }
  };

  void rescore(Index v) {
    const std::uint32_t version = ++version_[v];
    const double s = score(v);
    if (s < unreachable) queue_.push({s, random_ ? (*random_)() : v, v, version});
  }

  /// Entries of the table that the variable's elimination would make; beyond the limit infinite.
  double table(Index v) {
    if (links_.count(v) > most_) return unreachable;
    double entries = static_cast<double>(graph_.domain(v));
    for (const Index w : links_.of(v)) entries *= static_cast<double>(graph_.domain(w));
    return entries < limit_ ? entries : unreachable;
  }

  double score(Index v) {
    const double entries = table(v);
    watch_.poll(8);
    if (greed_ == Greed::table || entries == unreachable) return entries;
    const std::vector<Index>& near = links_.of(v);
    watch_.poll(4 * near.size() * near.size());
    double fill = 0;
    for (std::size_t i = 0; i < near.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!links_.linked(near[i], near[j]))
          fill += greed_ == Greed::fill ? 1.0 : static_cast<double>(graph_.domain(near[i]) * graph_.domain(near[j]));
    return fill;
  }

  /// Links what an elimination binds, and scores anew where that tells.
  void bind(const std::vector<Index>& bound) {
    touched_ = bound;
    for (std::size_t i = 0; i < bound.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (links_.linked(bound[i], bound[j])) continue;
        links_.link(bound[i], bound[j]);
        if (greed_ == Greed::table) continue;
        // Whoever has both as neighbours has one fill edge less.
        const bool first = links_.count(bound[i]) < links_.count(bound[j]);
        const Index few = first ? bound[i] : bound[j], many = first ? bound[j] : bound[i];
        for (const Index w : links_.of(few))
          if (w != many && links_.linked(many, w)) touched_.push_back(w);
        watch_.poll(4 * links_.count(few));
      }
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const Index w : touched_) rescore(w);
  }

  const FactorGraph& graph_;
  Links links_;
  Greed greed_;
  double limit_;
  std::size_t most_;  ///< neighbours of two values each that stay below the limit
  Watch& watch_;
  std::mt19937_64* random_ = nullptr;
  std::vector<std::uint32_t> version_;  ///< scores of an earlier one are void
  std::priority_queue<Scored> queue_;
  std::vector<Index> touched_;
};

}  // namespace

EliminationPlan elimination_plan(const FactorGraph& graph, double limit, Watch& watch) {
  constexpr int repetitions = 8;
  const Links links(graph);
  const double enough = 2 * entries(graph);
  EliminationPlan best;
  std::mt19937_64 random(1);
  const auto attempt = [&](Greed greed, std::mt19937_64* generator) {
    if (best.entries <= enough) return;
    EliminationPlan plan = GreedyOrder(graph, links, greed, std::min(limit, best.entries), watch).plan(generator);
    if (plan.entries < best.entries) best = std::move(plan);
  };
  for (const auto greed : {Greed::weighted_fill, Greed::fill, Greed::table}) attempt(greed, nullptr);
  for (int i = 0; i < repetitions; ++i)
    for (const auto greed : {Greed::weighted_fill, Greed::fill}) attempt(greed, &random);
  return best;
}

double cheap_entries(const FactorGraph& graph) {
  constexpr double small = 1 << 15;  // done in less than a millisecond
  // A search looks at every table at least, and where there are many variables at each many times.
  const double passes = std::clamp(static_cast<double>(graph.variables()) / 8, 4.0, 64.0);
  return std::max(small, passes * entries(graph));
}

}  // namespace toposcope::factors
