// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exact inference by elimination: a tree of buckets, one per variable. Each holds a table over its variable and those
// that the variable's elimination binds; messages go up the tree (sums, or minima) and, for the marginals, down again.
// All numbers are costs, -log of weights.

#include <span>
#include <vector>

#include "elimination_order.h"
#include "factors.h"
#include "watch.h"

namespace toposcope::posterior {

class Elimination {
 public:
  /// \param plan  feasible \throw OutOfTime
  Elimination(const FactorGraph& graph, const EliminationPlan& plan, Watch& watch);

  /// Least cost of all labellings; the tables then hold what `k_best` reads. \throw OutOfTime
  double minimize();

  /// -log of the sum over all labellings of exp(-cost). \throw OutOfTime
  double sum();

  /// Per variable, per value of the graph; after `sum`, which must have been finite. \throw OutOfTime
  std::vector<std::vector<double>> marginals();

  /// After `minimize`: offers labellings, each costing `least` and what its values lie above the minima of their
  /// buckets, until no other can cost at most the limit of `list`, to which the offers go, and `slack`.
  /// \return false when that is not proven: more nodes were needed than `most_nodes` \throw OutOfTime
  bool k_best(double least, const Offer& offer, const BestLabelings& list, double slack, std::size_t most_nodes);

 private:
  struct Bucket {
    Index variable = 0;
    std::vector<Index> bound;  ///< ascending
    std::size_t rows = 0;
    std::vector<double> table;    ///< over `bound`, then the variable
    std::vector<double> message;  ///< over `bound`
    std::vector<const Factor*> factors;
    Bucket* parent = nullptr;
    std::vector<Bucket*> children;
  };
  struct Listing;

  std::size_t stride(const std::vector<Index>& scope, Index variable) const;
  template <class Visit>
  void each_row(const Bucket& bucket, const std::vector<Index>& scope, const Visit& visit);
  void add(Bucket& bucket, const std::vector<Index>& scope, std::span<const double> costs);
  template <class Reduce>
  double constant_and_roots(const Reduce& reduce);
  void project(const Bucket& bucket, const std::vector<Index>& scope, std::vector<double>& costs);
  bool descend(std::size_t left, double cost, Listing& listing);

  const FactorGraph& graph_;
  Watch& watch_;
  std::vector<Index> order_;
  std::vector<Bucket> buckets_;
  std::vector<double> least_, sums_;
};

}  // namespace toposcope::posterior
