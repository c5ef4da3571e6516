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

/// The problem's tables as local search reads them. Shared by any number of searches; the problem must outlive it.
class CostTables {
 public:
  /// Reads every table twice. When the deadline is reached it stops early and is not `complete`.
  CostTables(const LabelingProblem& problem, Deadline& deadline);
  ~CostTables();
  CostTables(const CostTables&) = delete;
  CostTables& operator=(const CostTables&) = delete;

  /// That they were made of.
  const LabelingProblem& problem() const { return problem_; }
  /// Only then may a ConditionalCosts be made.
  bool complete() const;
  /// The constant, and the least costs of each variable and constraint, added in the order of `cost_of`: rounding is
  /// monotone, so no labelling costs less, to the last bit. -infinity when stopped before all were read; infinite where
  /// a variable has no allowed value.
  double lower_bound() const;
  /// More than the rounding of any sum of the finite costs.
  double slack() const { return slack_; }

  /// Values of all variables in one row: value `a` of variable v is position offset(v) + a.
  std::size_t offset(Index v) const { return offsets_[v]; }
  /// How many values a variable has.
  std::size_t domain(Index v) const { return offsets_[v + 1] - offsets_[v]; }
  /// The variable of a position.
  Index owner(std::size_t position) const { return owners_[position]; }
  /// Positions whose own cost is finite, by variable: all that local search looks at. Empty until all are read.
  std::span<const std::uint32_t> allowed() const { return allowed_; }
  /// Those of one variable.
  std::span<const std::uint32_t> allowed(Index v) const {
    return {allowed_.data() + allowed_offsets_[v], allowed_.data() + allowed_offsets_[v + 1]};
  }

  struct State;
  /// For the library itself.
  const State& state() const { return *state_; }

 private:
  const LabelingProblem& problem_;
  std::unique_ptr<const State> state_;
  // Of the state, for inner loops.
  double slack_;
  const std::size_t *offsets_, *allowed_offsets_;
  const Index* owners_;
  std::span<const std::uint32_t> allowed_;
};

/// A labelling and what every change of one variable would make of it. Forbidden entries and exclusions are counted,
/// never added up: they may be broken on the way.
class ConditionalCosts {
 public:
  /// \pre tables.complete(); they must outlive it
  explicit ConditionalCosts(const CostTables& tables);
  ~ConditionalCosts();
  ConditionalCosts(const ConditionalCosts&) = delete;
  ConditionalCosts& operator=(const ConditionalCosts&) = delete;

  /// Starts from a labelling; degree x domain for each variable.
  void reset(std::span<const Index> values);
  /// Gives a variable another value. No allocation.
  void assign(Index v, Index value);

  /// As they are now, one per variable.
  const std::vector<Index>& values() const { return values_; }
  double cost() const { return cost_; }            ///< sum of the finite costs, nats; rounding as in any sum
  std::int64_t broken() const { return broken_; }  ///< forbidden values and entries, and excluded pairs

  /// What the sum of finite costs would change by, nats.
  double cost_change(Index v, Index value) const {
    const double* own = costs_.data() + tables_.offset(v);
    return own[value] - own[values_[v]];
  }
  /// What `broken` would change by.
  std::int32_t broken_change(Index v, Index value) const;
  /// Exclusions that the value would break.
  std::int32_t excluders(Index v, Index value) const;
  /// Where the value would break one exclusion or one constraint over two variables and no more: the other variable.
  /// Else `v` itself.
  Index sole_opponent(Index v, Index value) const;

 private:
  struct State;
  const CostTables& tables_;
  std::vector<Index> values_;
  double cost_ = 0;
  std::int64_t broken_ = 0;
  std::vector<double> costs_;  ///< by position: its finite costs given the others
  std::unique_ptr<State> state_;
};

/// Moves one variable after the other to its best value, fewest broken first, then least cost, until none improves:
/// a local optimum. \return false when stopped
bool descend(const CostTables& tables, ConditionalCosts& costs, Deadline& deadline);

/// Offers the labelling, and each that differs in one variable, breaks nothing and may enter the list.
/// \return false when stopped
bool offer_neighbours(const CostTables& tables, const ConditionalCosts& costs, BestLabelings& best, Deadline& deadline);

}  // namespace toposcope
