// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sets of candidates that do not exclude each other, as a circuit: made once, evaluated for many weights.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// Candidates of one or more families, and which of them may not be taken together.
struct InstanceGraph {
  explicit InstanceGraph(std::vector<Index> color_of)
      : colors(std::move(color_of)), excluded(colors.size() * colors.size()), paired(excluded.size()) {}

  Index size() const { return static_cast<Index>(colors.size()); }
  bool excludes(Index u, Index v) const { return excluded[u * colors.size() + v] != 0; }
  bool pairs(Index u, Index v) const { return paired[u * colors.size() + v] != 0; }

  std::vector<Index> colors;     ///< per candidate: its family, from 0
  std::vector<char> excluded;    ///< square: never both
  std::vector<char> paired;      ///< square: taken together they weigh more or less than their product
  std::vector<Index> most = {};  ///< per color: instances at most
};

/// Logarithms of weights: of each candidate, and of each pair (square; empty: all 0).
struct InstanceWeights {
  std::vector<double> single, pair;
};

/// Every set is a path through the circuit once. A candidate whose removal takes the rest apart is decided first;
/// what falls apart is multiplied.
class InstanceCircuit {
 public:
  /// How a value of a node is numbered: by the numbers of instances of each color, the last fastest.
  using Shape = std::vector<Index>;

  /// \return nothing where it would have more nodes than `most_nodes`
  static std::optional<InstanceCircuit> make(const InstanceGraph& graph, std::size_t most_nodes);

  struct Node {
    enum class Kind : std::uint8_t { clique, product, branch };
    Kind kind = Kind::clique;
    std::vector<Index> candidates;  ///< of a clique; of a branch the one that is decided
    std::array<Index, 2> parts{};   ///< of a product; of a branch: what is left without the candidate, and with it
    std::vector<Index> weighed;     ///< of a branch: what is left with it and pairs with it
    Shape shape;
    Index entries = 1;
  };

  const std::vector<Node>& nodes() const {
    return nodes_;
  }  ///< parts before what is made of them; the last is the root
  const InstanceGraph& graph() const { return graph_; }

 private:
  explicit InstanceCircuit(const InstanceGraph& graph) : graph_(graph) {}
  Index build(std::vector<Index> candidates, bool remembered, std::size_t most_nodes);
  Index build_connected(const std::vector<Index>& candidates, bool remembered, std::size_t most_nodes);
  Index add(Node node);

  InstanceGraph graph_;
  std::vector<Node> nodes_;
  std::map<std::vector<Index>, Index> made_;
  bool too_many_ = false;
};

/// Sums over sets, by the numbers of instances.
class InstanceSums {
 public:
  explicit InstanceSums(const InstanceCircuit& circuit);

  /// \param number_weight_logs  per entry of the root: log weight of these numbers
  /// \return log of the sum over sets
  double sum(const InstanceWeights& weights, const std::vector<double>& number_weight_logs);
  /// Of the last sum: the probability of each entry of the root.
  const std::vector<double>& numbers() const { return numbers_; }
  /// Of the last sum: the probability that a set has each candidate.
  const std::vector<double>& marginals();

 private:
  using Real = long double;  // its exponent holds the product of a few hundred evidences

  void forward(Index node);
  void backward(Index node);

  const InstanceCircuit& circuit_;
  std::vector<std::vector<Real>> values_, slopes_;
  std::vector<double> scales_;             ///< log, of each node's values
  std::vector<Real> norms_;                ///< by which a node's values were divided
  std::vector<std::vector<double>> used_;  ///< log weights as they stood at a node
  std::vector<char> done_;
  std::vector<double> single_;
  const InstanceWeights* weights_ = nullptr;
  std::vector<double> numbers_, marginals_;
};

/// A set of candidates and minus the log of its weight.
struct InstanceSet {
  double cost;
  std::vector<Index> candidates;  ///< ascending
};

/// The sets of greatest weight, best first.
/// \param number_weight_logs  per entry of the root
std::vector<InstanceSet> best_sets(const InstanceCircuit& circuit, const InstanceWeights& weights,
                                   const std::vector<double>& number_weight_logs, std::size_t count);

}  // namespace toposcope
