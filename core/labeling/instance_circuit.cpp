// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "instance_sets.h"

namespace toposcope {
namespace {

bool touch(const InstanceGraph& graph, Index u, Index v) {
  return graph.excludes(u, v) || graph.pairs(u, v);
}

/// Of candidates, those that hang together.
std::vector<std::vector<Index>> components(const InstanceGraph& graph, std::vector<Index> left) {
  std::vector<std::vector<Index>> all;
  while (!left.empty()) {
    std::vector<Index>& component = all.emplace_back(1, left.front());
    left.erase(left.begin());
    for (std::size_t i = 0; i < component.size(); ++i) {
      const auto apart =
          std::stable_partition(left.begin(), left.end(), [&](Index u) { return !touch(graph, u, component[i]); });
      component.insert(component.end(), apart, left.end());
      left.erase(apart, left.end());
    }
    std::sort(component.begin(), component.end());
  }
  return all;
}

Index entries_of(const InstanceCircuit::Shape& shape) {
  Index entries = 1;
  for (const Index most : shape) entries *= most + 1;
  return entries;
}

}  // namespace

std::optional<InstanceCircuit> InstanceCircuit::make(const InstanceGraph& graph, std::size_t most_nodes) {
  InstanceCircuit circuit(graph);
  std::vector<Index> all(graph.size());
  for (Index u = 0; u < graph.size(); ++u) all[u] = u;
  Index root = circuit.add({});
  for (const std::vector<Index>& component : components(graph, std::move(all))) {
    // Where pairs have weights the same rest weighs differently on different paths.
    const bool paired = std::any_of(component.begin(), component.end(), [&](Index u) {
      return std::any_of(component.begin(), component.end(), [&](Index v) { return graph.pairs(u, v); });
    });
    const Index part = circuit.build_connected(component, !paired, most_nodes);
    if (circuit.too_many_) return std::nullopt;
    root = circuit.add({Node::Kind::product, {}, {root, part}, {}, {}, 1});
  }
  circuit.made_.clear();
  return circuit;
}

Index InstanceCircuit::add(Node node) {
  const std::size_t colors = graph_.most.size();
  node.shape.assign(colors, 0);
  const auto shape = [&](std::size_t part) -> const Shape& { return nodes_[node.parts[part]].shape; };
  switch (node.kind) {
    case Node::Kind::clique:
      for (const Index u : node.candidates) node.shape[graph_.colors[u]] = 1;
      break;
    case Node::Kind::product:
      for (std::size_t c = 0; c < colors; ++c) node.shape[c] = shape(0)[c] + shape(1)[c];
      break;
    case Node::Kind::branch:
      for (std::size_t c = 0; c < colors; ++c)
        node.shape[c] = std::max(shape(0)[c], shape(1)[c] + (graph_.colors[node.candidates[0]] == c ? 1 : 0));
      break;
  }
  for (std::size_t c = 0; c < colors; ++c) node.shape[c] = std::min(node.shape[c], graph_.most[c]);
  node.entries = entries_of(node.shape);
  nodes_.push_back(std::move(node));
  return static_cast<Index>(nodes_.size() - 1);
}

Index InstanceCircuit::build(std::vector<Index> candidates, bool remembered, std::size_t most_nodes) {
  if (candidates.empty()) return add({});
  std::optional<Index> product;
  for (const std::vector<Index>& component : components(graph_, std::move(candidates))) {
    const Index part = build_connected(component, remembered, most_nodes);
    if (too_many_) return 0;
    product = product ? add({Node::Kind::product, {}, {*product, part}, {}, {}, 1}) : part;
  }
  return *product;
}

Index InstanceCircuit::build_connected(const std::vector<Index>& candidates, bool remembered, std::size_t most_nodes) {
  if (nodes_.size() > most_nodes) too_many_ = true;
  if (too_many_) return 0;
  if (remembered)
    if (const auto known = made_.find(candidates); known != made_.end()) return known->second;
  Index decided = candidates.front();
  std::size_t most_touched = 0;
  bool clique = true;
  for (const Index u : candidates) {
    std::size_t touched = 0;
    for (const Index v : candidates) {
      touched += u != v && touch(graph_, u, v) ? 1 : 0;
      clique = clique && (u == v || graph_.excludes(u, v));
    }
    if (touched > most_touched) most_touched = touched, decided = u;
  }
  Node node;
  if (clique) {
    node.candidates = candidates;
  } else {
    node.kind = Node::Kind::branch;
    node.candidates = {decided};
    std::vector<Index> without, with;
    for (const Index u : candidates) {
      if (u == decided) continue;
      without.push_back(u);
      if (graph_.excludes(u, decided)) continue;
      with.push_back(u);
      if (graph_.pairs(u, decided)) node.weighed.push_back(u);
    }
    node.parts[0] = build(std::move(without), remembered, most_nodes);
    if (too_many_) return 0;
    node.parts[1] = build(std::move(with), remembered, most_nodes);
    if (too_many_) return 0;
  }
  const Index made = add(std::move(node));
  if (remembered) made_.emplace(candidates, made);
  return made;
}

}  // namespace toposcope
