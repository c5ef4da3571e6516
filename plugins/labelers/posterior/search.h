// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Depth-first search over the tree of labellings, with forward checking: for the best labellings, by branch and bound,
// and for the sums over all labellings, leaving out subtrees whose mass is proven negligible.

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "search_tables.h"
#include "toposcope/labeling/watch.h"

namespace toposcope::posterior {

/// Sums of exp(reference - cost).
struct Sums {
  double total = 0;
  double omitted = 0;          ///< no more than this was left out of `total`
  std::vector<double> values;  ///< per variable in search order, per value
  bool finished = false;       ///< false: more nodes were needed than allowed
};

class Search {
 public:
  /// \param nodes  counted on
  Search(const FactorGraph& graph, const SearchTables& tables, double slack, Watch& watch, std::uint64_t& nodes);

  /// Bytes that a search and its tables take, about.
  static double bytes(const FactorGraph& graph);

  /// Offers labellings until no other can cost at most the limit of `list`, to which the offers go.
  /// \return false when that took more than `most_nodes` \throw OutOfTime
  bool best(const Offer& offer, const BestLabelings& list, std::uint64_t most_nodes);

  /// \param reference  the least cost
  /// \param tolerance  what may be left out, as part of exp(reference - least cost) = 1 \throw OutOfTime
  Sums sum(double reference, double tolerance, std::uint64_t most_nodes);

 private:
  static constexpr double underflow = 740;  ///< exp of less than minus that may be 0

  struct Child {
    double key;  ///< bound of the cost, or of the mass
    Index value;
    bool operator<(const Child& other) const { return std::tie(key, value) < std::tie(other.key, other.value); }
  };

  double* costs(Index depth) { return costs_.data() + depth * width_; }
  double* weights(Index depth) { return weights_.data() + depth * width_; }
  /// Least cost among the values of a variable to come.
  double& least(Index depth, Index later) { return least_[depth * tables_.depths() + later]; }
  /// log of the sum over its values of exp(least cost - cost).
  double& log_mass(Index depth, Index later) { return log_mass_[depth * tables_.depths() + later]; }

  void find_least(Index depth, Index later);
  void weigh(Index depth, Index later);
  void assign(Index depth, Index value);
  bool descend(Index depth, double cost, const Offer& offer, const BestLabelings& list);

  /// An upper bound of the mass: no overflow, for what is so large is never left out.
  static double bounded_exp(double exponent) { return std::exp(std::min(exponent, underflow / 2)); }
  double add_up(Index depth, double cost, double rest, double rest_mass, double budget);
  void leave_out(double mass, double& budget);
  double visit(Index depth, Index value, double cost, double allowed, double& budget);

  const FactorGraph& graph_;
  const SearchTables& tables_;
  double slack_;
  Watch& watch_;
  std::uint64_t& nodes_;
  std::size_t width_;
  std::vector<Index> at_;  ///< by depth: position among the graph's values
  std::vector<Index> labeling_;
  std::vector<double> costs_, weights_, least_, log_mass_, log_domain_;
  std::vector<std::vector<char>> touched_;  ///< [depth][later]: an assignment at `depth` adds to the costs of `later`
  std::vector<std::vector<Child>> children_;
  double reference_ = 0;
  Sums sums_;
  std::uint64_t most_nodes_ = 0;
};

}  // namespace toposcope::posterior
