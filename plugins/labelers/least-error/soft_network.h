// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A labelling problem as a weighted constraint network in integers: a constant, unary costs and binary cost functions
// between which costs may be moved without changing any labelling's (Cooper & Schiex 2004), with a trail to undo it.
// Functions of three and more variables wait until two of theirs are unassigned and then join a binary one.

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "kernels.h"
#include "toposcope/labeling.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::least_error {

/// A binary cost function: cost(a, b) = table(a, b) - moved[0][a] - moved[1][b].
struct BinaryFunction {
  int variable[2];
  std::vector<Cost> table[2];  ///< rows over the values of variable[0], and transposed
  std::size_t moved[2];        ///< offsets in SoftNetwork::costs: projected to (+) or extended from (-) the variable
  double weight = 1;           ///< failures met here (dom/wdeg)
};

/// One over three or more variables.
struct DelayedFunction {
  std::vector<int> variables;
  std::vector<std::size_t> strides;
  std::vector<Cost> table;
};

class SoftNetwork {
 public:
  static constexpr double largest_sum = 1 << 26;  ///< of all units: moved costs stay far below `infinite`

  /// \param deadline  asked while the tables are made; complete() is false where it struck
  SoftNetwork(const LabelingProblem& problem, Deadline& deadline);
  bool complete() const { return complete_; }

  /// The problem's, and after them those that were added.
  int variables() const { return static_cast<int>(size_.size()); }
  int size(int variable) const { return size_[variable]; }
  Cost* unary(int variable) { return costs_.data() + unary_[variable]; }
  const Cost* unary(int variable) const { return costs_.data() + unary_[variable]; }
  /// Values still there, in no order.
  std::span<const int> values(int variable) const {
    return {order_.data() + first_[variable], static_cast<std::size_t>(count_[variable])};
  }
  int count(int variable) const { return count_[variable]; }
  bool has(int variable, int value) const { return place_[first_[variable] + value] < count_[variable]; }
  /// Functions of a variable: index and the variable's side.
  struct Use {
    int function, side;
  };
  std::span<const Use> uses(int variable) const { return uses_[variable]; }
  BinaryFunction& function(int f) { return functions_[f]; }
  const BinaryFunction& function(int f) const { return functions_[f]; }
  std::size_t function_count() const { return functions_.size(); }
  /// Most functions forbid and cost nothing else, as they were made.
  bool mostly_crisp() const { return 2 * crisp_ > functions_.size(); }
  Cost* moved(const BinaryFunction& f, int side) { return costs_.data() + f.moved[side]; }
  const Cost* moved(const BinaryFunction& f, int side) const { return costs_.data() + f.moved[side]; }

  Cost constant() const { return constant_; }
  void add_constant(Cost cost) { constant_ += cost; }

  /// Before the first change of a block since the last mark.
  void save_unary(int variable) { save(unary_[variable], size_[variable], stamp_[variable]); }
  void save_moved(int f, int side) {
    save(functions_[f].moved[side], size_[functions_[f].variable[side]],
         stamp_[size_.size() + 2 * static_cast<std::size_t>(f) + side]);
  }
  void remove(int variable, int value);

  /// Everything changed since is undone by `undo`.
  void mark();
  void undo();
  std::size_t depth() const { return marks_.size(); }

  /// To be told of each variable once it has one value: values of others that it excludes are handed to
  /// `strike(variable, value)`, binary functions that got new costs to `changed(f)`.
  template <class Strike, class Changed>
  void assigned(int variable, const Strike& strike, const Changed& changed) {
    strike_excluded(variable, strike);
    for (const int d : delayed_uses_[variable]) {
      const int f = release(d);
      if (f >= 0) changed(f);
    }
  }

  /// The problem's values.
  Index value_of(int variable, int value) const { return values_[first_[variable] + value]; }
  double to_cost(double units) const { return offset_ + units / scale_; }
  /// Lower bound of a labelling's cost that the constant proves.
  double bound(Cost constant) const;
  /// Units that no labelling of cost below `limit` (or at it, with `inclusive`) reaches.
  Cost cutoff(double limit, bool inclusive) const;
  /// A value of some variable is impossible in any labelling of finite cost: nothing is left.
  bool infeasible() const { return infeasible_; }

 private:
  struct Saved {
    std::size_t offset, length, data;
    std::uint64_t* stamp;
    std::uint64_t old_stamp;
  };
  struct Mark {
    std::size_t saved, data, removed, released;
    Cost constant;
    std::uint64_t stamp;
  };
  struct Release {
    int delayed, function;
    std::size_t data;
  };

  void save(std::size_t offset, int length, std::uint64_t& stamp) {
    if (stamp == now_ || marks_.empty()) return;
    saved_.push_back({offset, static_cast<std::size_t>(length), saved_costs_.size(), &stamp, stamp});
    saved_costs_.insert(saved_costs_.end(), costs_.begin() + static_cast<std::ptrdiff_t>(offset),
                        costs_.begin() + static_cast<std::ptrdiff_t>(offset) + length);
    stamp = now_;
  }
  struct Terms;
  bool read_variables(Terms& terms);
  bool read_constraints(Terms& terms, Deadline& deadline);
  bool make_functions(Terms& terms, Deadline& deadline);
  void add_binary(int x, int y, std::span<const double> costs);
  void add_delayed(const std::vector<int>& variables, std::span<const double> costs);
  void complete_functions();
  int function_between(int x, int y);
  int best_value(int variable) const;
  void add_cliques();
  void drop_covered(std::set<std::pair<int, int>> covered);
  int add_variable(int size);
  void project_delayed();
  Cost units(double cost) const;
  int release(int delayed);
  bool excludes(int variable, int value, int other, int other_value) const {
    const Index a = candidates_[first_[variable] + value], b = candidates_[first_[other] + other_value];
    return a != no_candidate && b != no_candidate && problem_.conflict(a, b);
  }
  template <class Strike>
  void strike_excluded(int variable, const Strike& strike) {
    const int value = values(variable)[0];
    if (candidates_[first_[variable] + value] == no_candidate) return;
    for (int other = 0; other < variables(); ++other) {
      if (other == variable || candidates_[first_[other] + size_[other] - 1] == no_candidate) continue;
      for (int k = count_[other] - 1; k >= 0; --k) {
        const int struck = order_[first_[other] + k];
        if (excludes(variable, value, other, struck)) strike(other, struck);
      }
    }
  }

  const LabelingProblem& problem_;
  bool complete_ = true, infeasible_ = false;
  std::size_t crisp_ = 0;  ///< functions
  /// Of a sum in steps: rounding alone.
  static constexpr double exact_error = 1e-3;
  double offset_ = 0, scale_ = 1, error_ = 0;
  double step_ = 0;  ///< costs of labellings are multiples of so many units; 0: of none

  std::vector<int> size_, count_;
  std::vector<int> first_;          ///< of a variable's values in order_, place_, values_, candidates_
  std::vector<int> order_, place_;  ///< sparse sets: the first count_ of order_ are there
  std::vector<Index> values_, candidates_;
  std::vector<std::size_t> unary_;  ///< offsets in costs_
  std::vector<Cost> costs_;         ///< unary costs and moved costs
  Cost constant_ = 0;
  std::vector<BinaryFunction> functions_;
  std::vector<std::vector<Use>> uses_;
  std::map<std::pair<int, int>, int> between_;  ///< function of a pair
  std::vector<DelayedFunction> delayed_;
  std::vector<std::vector<int>> delayed_uses_;
  std::vector<char> released_;

  std::vector<std::uint64_t> stamp_;  ///< of the blocks: unary, then two per function
  std::uint64_t now_ = 1, stamps_ = 1;
  std::vector<Saved> saved_;
  std::vector<Cost> saved_costs_;
  std::vector<int> removed_;  ///< variables, in the order of their losses
  std::vector<Release> releases_;
  std::vector<Cost> released_costs_;
  std::vector<Mark> marks_;
};

}  // namespace toposcope::least_error
