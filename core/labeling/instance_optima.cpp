// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "instance_entries.h"
#include "instance_sets.h"

namespace toposcope {
namespace {

/// A set of a node, by the sets of its parts that it is made of.
struct Choice {
  double cost = 0;
  Index candidate = 0;                      ///< of a clique or a branch
  bool takes = false;                       ///< it
  std::array<Index, 2> entries{}, ranks{};  ///< in its parts
};

/// The best few of each entry of each node.
class BestSets {
 public:
  BestSets(const InstanceCircuit& circuit, const InstanceWeights& weights, std::size_t count)
      : circuit_(circuit), weights_(weights), single_(weights.single), count_(count), kept_(circuit.nodes().size()) {}

  void run() { forward(root()); }
  Index root() const { return static_cast<Index>(kept_.size() - 1); }
  const std::vector<Choice>& of_root(Index entry) const { return kept_[root()][entry]; }

  void collect(Index n, const Choice& choice, std::vector<Index>& set) const {
    const InstanceCircuit::Node& node = circuit_.nodes()[n];
    if (choice.takes) set.push_back(choice.candidate);
    using Kind = InstanceCircuit::Node::Kind;
    const auto part = [&](std::size_t side) {
      collect(node.parts[side], kept_[node.parts[side]][choice.entries[side]][choice.ranks[side]], set);
    };
    if (node.kind == Kind::product) {
      part(0);
      part(1);
    } else if (node.kind == Kind::branch) {
      part(choice.takes ? 1 : 0);
    }
  }

 private:
  using Kept = std::vector<std::vector<Choice>>;  ///< per entry, best first

  void forward(Index n) {
    if (!kept_[n].empty()) return;
    const InstanceCircuit::Node& node = circuit_.nodes()[n];
    Kept kept(node.entries);
    using Kind = InstanceCircuit::Node::Kind;
    if (node.kind == Kind::clique) {
      kept[0].push_back({});
      for (const Index u : node.candidates)
        if (const auto entry = entry_with(circuit_, node, u)) offer(kept[*entry], {-single_[u], u, true, {}, {}});
    } else if (node.kind == Kind::product) {
      forward(node.parts[0]);
      forward(node.parts[1]);
      for_each_product(circuit_, node, [&](Index i, Index j, Index k) { multiply(node, {i, j}, kept[k]); });
    } else {
      branch(node, kept);
    }
    for (std::vector<Choice>& entry : kept) trim(entry);
    kept_[n] = std::move(kept);
  }

  void branch(const InstanceCircuit::Node& node, Kept& kept) {
    const Index decided = node.candidates[0];
    const double cost = -single_[decided];
    forward(node.parts[0]);
    const std::vector<double> before = single_;
    for (const Index u : node.weighed) single_[u] += weights_.pair[decided * circuit_.graph().size() + u];
    forward(node.parts[1]);
    single_ = before;
    for_each_entry(circuit_, node, node.parts[0], [&](Index i, Index k) {
      const std::vector<Choice>& from = kept_[node.parts[0]][i];
      for (Index rank = 0; rank < from.size(); ++rank)
        offer(kept[k], {from[rank].cost, decided, false, {i, 0}, {rank, 0}});
    });
    for_each_entry_with(circuit_, node, [&](Index i, Index k) {
      const std::vector<Choice>& from = kept_[node.parts[1]][i];
      for (Index rank = 0; rank < from.size(); ++rank)
        offer(kept[k], {from[rank].cost + cost, decided, true, {0, i}, {0, rank}});
    });
  }

  void multiply(const InstanceCircuit::Node& node, const std::array<Index, 2>& entries, std::vector<Choice>& kept) {
    const std::vector<Choice>&a = kept_[node.parts[0]][entries[0]], &b = kept_[node.parts[1]][entries[1]];
    for (Index i = 0; i < a.size(); ++i)
      for (Index j = 0; j < b.size() && (i + 1) * (j + 1) <= count_; ++j)
        offer(kept, {a[i].cost + b[j].cost, 0, false, entries, {i, j}});
  }

  void offer(std::vector<Choice>& kept, const Choice& choice) {
    if (!(choice.cost < std::numeric_limits<double>::infinity())) return;
    kept.push_back(choice);
    if (kept.size() > 8 * count_) trim(kept);
  }

  void trim(std::vector<Choice>& kept) const {
    std::stable_sort(kept.begin(), kept.end(), [](const Choice& a, const Choice& b) { return a.cost < b.cost; });
    if (kept.size() > count_) kept.resize(count_);
  }

  const InstanceCircuit& circuit_;
  const InstanceWeights& weights_;
  std::vector<double> single_;
  std::size_t count_;
  std::vector<Kept> kept_;  ///< per node
};

}  // namespace

std::vector<InstanceSet> best_sets(const InstanceCircuit& circuit, const InstanceWeights& weights,
                                   const std::vector<double>& number_weight_logs, std::size_t count) {
  BestSets best(circuit, weights, count);
  best.run();
  std::vector<std::pair<double, const Choice*>> order;
  for (Index entry = 0; entry < circuit.nodes().back().entries; ++entry)
    for (const Choice& choice : best.of_root(entry)) {
      const double cost = choice.cost - number_weight_logs[entry];
      if (cost < std::numeric_limits<double>::infinity()) order.emplace_back(cost, &choice);
    }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (order.size() > count) order.resize(count);
  std::vector<InstanceSet> sets;
  for (const auto& [cost, choice] : order) {
    InstanceSet& set = sets.emplace_back(InstanceSet{cost, {}});
    best.collect(best.root(), *choice, set.candidates);
    std::sort(set.candidates.begin(), set.candidates.end());
  }
  return sets;
}

}  // namespace toposcope
