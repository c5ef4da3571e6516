// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What every labeler asks of a labelling problem. Plugins have these without a line of their own.

#include <chrono>
#include <limits>
#include <span>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope {

inline constexpr double forbidden = std::numeric_limits<double>::infinity();

/// \throw std::invalid_argument  tables that do not fit their domains, empty domains, numbers that are no costs
void check(const LabelingProblem& problem);

/// Position in a constraint's tables of the problem-wide `values`.
inline std::size_t table_entry(const LabelingProblem& problem, const LabelingConstraint& constraint,
                               std::span<const Index> values) {
  std::size_t entry = 0;
  for (const Index v : constraint.scope) entry = entry * problem.variables[v].domain() + values[v];
  return entry;
}

/// Moves `digits`, the scope's own values, to the next entry of a constraint's tables; false after the last.
inline bool next_entry(const LabelingProblem& problem, const LabelingConstraint& constraint, std::span<Index> digits) {
  for (std::size_t k = digits.size(); k-- > 0;) {
    if (++digits[k] < problem.variables[constraint.scope[k]].domain()) return true;
    digits[k] = 0;
  }
  return false;
}

/// True where the crisp form is met: violation at most 1, or no violations and a finite cost.
inline bool satisfied(const LabelingConstraint& constraint, std::size_t entry) {
  return constraint.violations.empty() ? constraint.costs[entry] < forbidden : constraint.violations[entry] <= 1;
}

/// True where the crisp problem's constraint lets the entry of its tables be: it is satisfied and its cost is finite.
inline bool allowed(const LabelingConstraint& constraint, std::size_t entry) {
  return constraint.costs[entry] < forbidden && satisfied(constraint, entry);
}

/// True where the two values may not both be labelled: their candidates share a vertex.
bool excluded(const LabelingProblem& problem, Index variable, Index value, Index other, Index other_value);

/// No two labelled candidates exclude each other.
bool meets_exclusions(const LabelingProblem& problem, std::span<const Index> values);

/// The constant, the unary costs and the constraints' costs, summed in the problem's order; infinite where an exclusion
/// is broken. The one way in which a labelling's cost is made, so that equal labellings cost the same to the last bit.
double cost_of(const LabelingProblem& problem, std::span<const Index> values);

/// Exclusions met, every constraint satisfied, every cost finite: a solution of the crisp problem.
bool consistent(const LabelingProblem& problem, std::span<const Index> values);

/// More than the rounding of any sum of the problem's finite costs, in any order.
double rounding_slack(const LabelingProblem& problem);

/// All missing, where every variable may be.
std::vector<Labeling> all_missing(const LabelingProblem& problem);

/// Keeps the k best labellings offered, best first; ties are broken by the values, so that the result does not depend
/// on the order of the offers. Offering one twice keeps it once.
class BestLabelings {
 public:
  /// Keeps at most `capacity`, none of which costs over `within` nats more than the best.
  BestLabelings(std::size_t capacity, double within) : capacity_(capacity), within_(within) {}
  /// \return true when it entered the list
  bool offer(const Labeling& labeling);
  /// No labelling costlier than this can enter.
  double limit() const;
  /// Those kept, the best first.
  const std::vector<Labeling>& labelings() const { return labelings_; }
  /// Hands them over; the list is then empty.
  std::vector<Labeling> take() { return std::move(labelings_); }

 private:
  std::size_t capacity_;
  double within_;
  std::vector<Labeling> labelings_;
};

/// Says when to stop: out of time, or cancelled.
class Deadline {
 public:
  /// Time begins to run. The context must outlive it.
  Deadline(double time_limit_s, const Context& context)
      : context_(context), begin_(Clock::now()), limit_s_(time_limit_s) {}
  /// Out of time or cancelled; stays true.
  bool reached() {
    if (!reached_) reached_ = context_.cancelled() || elapsed_s() >= limit_s_;
    return reached_;
  }
  /// Seconds since it was made.
  double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  const Context& context_;
  Clock::time_point begin_;
  double limit_s_;
  bool reached_ = false;
};

}  // namespace toposcope
