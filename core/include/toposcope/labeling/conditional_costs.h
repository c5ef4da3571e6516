// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Local search over labellings: what each value of each variable would cost given the values of all others, kept up to
// date from move to move, so that a move is judged in constant time and made in degree x domain.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "toposcope/labeling/tools.h"

namespace toposcope {

/// The problem's tables as local search reads them: both orientations of a pair's costs, what is forbidden apart,, and
/// for each candidate those that it excludes. Shared by any number of searches; the problem must outlive it.
class CostTables {
 public:
  /// Reads every table twice. When the deadline is reached it stops early and is not `complete`.
  CostTables(const LabelingProblem& problem, Deadline& deadline);
  CostTables(const CostTables&) = delete;
  CostTables& operator=(const CostTables&) = delete;

  const LabelingProblem& problem() const { return problem_; }
  /// Only then may a ConditionalCosts be made.
  bool complete() const { return complete_; }
  /// The constant, and the least costs of each variable and constraint, added in the order of `cost_of`: rounding is
  /// monotone, so no labelling costs less, to the last bit. -infinity when stopped before all were read; infinite where
  /// a variable has no allowed value.
  double lower_bound() const { return lower_bound_; }
  /// More than the rounding of any sum of the finite costs.
  double slack() const { return slack_; }

  /// Values of all variables in one row: value `a` of variable v is position offset(v) + a.
  std::size_t offset(Index v) const { return offsets_[v]; }
  std::size_t domain(Index v) const { return offsets_[v + 1] - offsets_[v]; }
  std::size_t positions() const { return offsets_.back(); }
  Index owner(std::size_t position) const { return owners_[position]; }
  /// Row of the conflict table, or `no_candidate`.
  Index candidate(std::size_t position) const { return candidates_[position]; }
  /// Positions whose own cost is finite, by variable: all that local search looks at.
  std::span<const std::uint32_t> allowed() const { return allowed_; }
  std::span<const std::uint32_t> allowed(Index v) const {
    return {allowed_.data() + allowed_offsets_[v], allowed_.data() + allowed_offsets_[v + 1]};
  }
  std::span<const Index> conflicts(Index candidate) const {
    return {conflicts_.data() + conflict_offsets_[candidate], conflicts_.data() + conflict_offsets_[candidate + 1]};
  }

 private:
  friend class ConditionalCosts;
  /// A constraint over two variables, as one of them sees it: row-major, own variable first.
  struct Pair {
    const double* costs;          ///< 0 where infinite; null where all are 0
    const std::uint8_t* entries;  ///< 1 where infinite, else 0; null where nothing is
    Index other;
  };
  /// A constraint over three or more, as one of its variables sees it.
  struct Wide {
    Index constraint, place;
  };

  void read_variables();
  bool read_constraints(Deadline& deadline);
  bool read_pairs(Deadline& deadline);
  Pair see_pair(Index constraint, bool second);
  bool list_conflicts(Deadline& deadline);

  const LabelingProblem& problem_;
  bool complete_ = false;
  double lower_bound_ = -forbidden, slack_ = 0;
  std::vector<std::size_t> offsets_, allowed_offsets_, conflict_offsets_;
  std::vector<Index> owners_, candidates_, conflicts_;
  std::vector<std::uint32_t> allowed_;
  std::vector<double> unary_;           ///< by position: own cost and that of constraints over the variable alone
  std::vector<bool> forbids_, weighs_;  ///< by constraint: some cost is infinite; is finite and not 0
  std::vector<std::vector<Pair>> pairs_;
  std::vector<std::vector<Wide>> wide_;
  std::vector<std::unique_ptr<double[]>> own_costs_;
  std::vector<std::unique_ptr<std::uint8_t[]>> own_entries_;
};

/// A labelling and what every change of one variable would make of it. Forbidden entries and exclusions are counted,
/// never added up: they may be broken on the way.
class ConditionalCosts {
 public:
  /// \pre tables.complete(); they must outlive it
  explicit ConditionalCosts(const CostTables& tables);

  /// Starts from a labelling; degree x domain for each variable.
  void reset(std::span<const Index> values);
  /// Gives a variable another value. No allocation.
  void assign(Index v, Index value);

  const std::vector<Index>& values() const { return values_; }
  double cost() const { return cost_; }            ///< sum of the finite costs; rounding as in any sum
  std::int64_t broken() const { return broken_; }  ///< forbidden values and entries, and excluded pairs

  /// What the sum of finite costs would change by.
  double cost_change(Index v, Index value) const { return costs_[at(v, value)] - costs_[at(v, values_[v])]; }
  /// What `broken` would change by.
  std::int32_t broken_change(Index v, Index value) const { return broken_of(v, value) - broken_of(v, values_[v]); }
  /// Exclusions that the value would break.
  std::int32_t excluders(Index v, Index value) const;
  /// Where the value would break one exclusion or one constraint over two variables and no more: the other variable.
  /// Else `v` itself.
  Index sole_opponent(Index v, Index value) const;

 private:
  std::size_t at(Index v, Index value) const { return tables_.offsets_[v] + value; }
  std::int32_t broken_of(Index v, Index value) const { return entries_[at(v, value)] + excluders(v, value); }
  bool own_conflict(Index v, Index candidate) const;
  void use(Index v, std::size_t position, std::int32_t sign);
  void move_wide(Index v, Index from, Index to);

  const CostTables& tables_;
  std::vector<Index> values_;
  double cost_ = 0;
  std::int64_t broken_ = 0;
  std::vector<double> costs_;          ///< by position: its finite costs given the others
  std::vector<std::int32_t> entries_;  ///< by position: its forbidden entries given the others
  std::vector<std::int32_t> used_;     ///< by candidate: variables whose candidates conflict with it
  std::vector<std::uint64_t> users_;   ///< by candidate: sum of those variables
};

/// Moves one variable after the other to its best value, fewest broken first, then least cost, until none improves:
/// a local optimum. \return false when stopped
bool descend(const CostTables& tables, ConditionalCosts& costs, Deadline& deadline);

/// Offers the labelling, and each that differs in one variable, breaks nothing and may enter the list.
void offer_neighbours(const CostTables& tables, const ConditionalCosts& costs, BestLabelings& best);

}  // namespace toposcope
