// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How the entries of a node's value belong to those of its parts: by numbers of instances of each color.

#include <optional>
#include <vector>

#include "instance_sets.h"

namespace toposcope {

/// The entry of a shape for these numbers; nothing where they are more than it has.
inline std::optional<Index> entry_of(const InstanceCircuit::Shape& shape, const std::vector<Index>& numbers) {
  Index entry = 0;
  for (std::size_t c = 0; c < shape.size(); ++c) {
    if (numbers[c] > shape[c]) return std::nullopt;
    entry = entry * (shape[c] + 1) + numbers[c];
  }
  return entry;
}

inline std::vector<Index> numbers_of(const InstanceCircuit::Shape& shape, Index entry) {
  std::vector<Index> numbers(shape.size());
  for (std::size_t c = shape.size(); c-- > 0;) {
    numbers[c] = entry % (shape[c] + 1);
    entry /= shape[c] + 1;
  }
  return numbers;
}

/// The node's entry for one candidate alone.
inline std::optional<Index> entry_with(const InstanceCircuit& circuit, const InstanceCircuit::Node& node,
                                       Index candidate) {
  std::vector<Index> numbers(node.shape.size(), 0);
  numbers[circuit.graph().colors[candidate]] = 1;
  return entry_of(node.shape, numbers);
}

/// Calls visit(i, k) for each entry i of a part that is entry k of the node.
template <class Visit>
void for_each_entry(const InstanceCircuit& circuit, const InstanceCircuit::Node& node, Index part, const Visit& visit) {
  const InstanceCircuit::Node& from = circuit.nodes()[part];
  for (Index i = 0; i < from.entries; ++i)
    if (const auto k = entry_of(node.shape, numbers_of(from.shape, i))) visit(i, *k);
}

/// The same of a branch's second part, with the candidate that was decided.
template <class Visit>
void for_each_entry_with(const InstanceCircuit& circuit, const InstanceCircuit::Node& node, const Visit& visit) {
  const InstanceCircuit::Node& from = circuit.nodes()[node.parts[1]];
  const Index color = circuit.graph().colors[node.candidates[0]];
  for (Index i = 0; i < from.entries; ++i) {
    std::vector<Index> numbers = numbers_of(from.shape, i);
    ++numbers[color];
    if (const auto k = entry_of(node.shape, numbers)) visit(i, *k);
  }
}

/// Calls visit(i, j, k) for entries i and j of the two parts that together are entry k of a product.
template <class Visit>
void for_each_product(const InstanceCircuit& circuit, const InstanceCircuit::Node& node, const Visit& visit) {
  const InstanceCircuit::Node &a = circuit.nodes()[node.parts[0]], &b = circuit.nodes()[node.parts[1]];
  if (node.shape.size() == 1) {
    for (Index i = 0; i < a.entries; ++i)
      for (Index j = 0; j < b.entries && i + j < node.entries; ++j) visit(i, j, i + j);
    return;
  }
  for (Index i = 0; i < a.entries; ++i) {
    const std::vector<Index> first = numbers_of(a.shape, i);
    for (Index j = 0; j < b.entries; ++j) {
      std::vector<Index> numbers = numbers_of(b.shape, j);
      for (std::size_t c = 0; c < numbers.size(); ++c) numbers[c] += first[c];
      if (const auto k = entry_of(node.shape, numbers)) visit(i, j, *k);
    }
  }
}

}  // namespace toposcope
