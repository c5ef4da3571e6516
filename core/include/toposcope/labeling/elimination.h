// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exact inference by elimination: a tree of buckets, one per variable. Each holds a table over its variable and those
// that the variable's elimination binds; messages go up the tree (sums, or minima) and, for the marginals, down again.
// All numbers are costs, -log of weights. Time and memory are those of the tables: linear on chains and trees.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "toposcope/labeling/factor_graph.h"
#include "toposcope/labeling/watch.h"

namespace toposcope::factors {

/// In which order to eliminate variables, and how large the tables then are.
struct EliminationPlan {
  std::vector<Index> order;                   ///< variables, first eliminated first
  std::vector<std::vector<Index>> neighbors;  ///< per variable: those that its elimination binds, ascending; never ones
                                              ///< of a single value, which bind nothing
  double entries = std::numeric_limits<double>::infinity();  ///< of all tables together

  /// More than an Elimination by this plan takes.
  double bytes() const { return 24 * entries; }
};

/// The best of several greedy orders: least fill, least weighted fill, least table, and repetitions in which ties are
/// drawn; the first that needs little more than the graph's own tables. Entries are infinite where no order is below
/// `limit`. Takes time in proportion to the graph's links where few variables are bound at a time.
/// \throw OutOfTime
EliminationPlan elimination_plan(const FactorGraph& graph, double limit, Watch& watch);

/// Entries of all tables up to which no search is expected to be faster: 32,768, or as many times those of the graph as
/// an eighth of its variables (from 4 to 64 times).
double cheap_entries(const FactorGraph& graph);

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

  /// What `k_best` is asked for.
  struct Listing {
    std::size_t k = 1;   ///< labellings wanted
    double slack = 0;    ///< more than the rounding of any labelling's cost
    const Offer& offer;  ///< hands labellings to `list`
    const BestLabelings& list;
  };
  /// After `minimize`: offers labellings by rising cost, each costing `least` and what its values lie above the minima
  /// of their buckets, until no other can cost at most the limit of the list, or all that are left cost as much as its
  /// last but for rounding. Time for each in proportion to the variables [Lawler1972]. \throw OutOfTime
  void k_best(double least, const Listing& listing);

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
  class Ranking;

  std::size_t stride(const std::vector<Index>& scope, Index variable) const;
  template <class Visit>
  void each_row(const Bucket& bucket, const std::vector<Index>& scope, const Visit& visit);
  void add(Bucket& bucket, const std::vector<Index>& scope, std::span<const double> costs);
  template <class Reduce>
  double constant_and_roots(const Reduce& reduce);
  void project(const Bucket& bucket, const std::vector<Index>& scope, std::vector<double>& costs);

  const FactorGraph& graph_;
  Watch& watch_;
  std::vector<Index> order_;
  std::vector<Bucket> buckets_;
  std::vector<double> least_, sums_;
};

}  // namespace toposcope::factors
