// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Why not: the smallest set of constraints and exclusions that cannot all be met.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "toposcope/labeling/tools.h"

namespace toposcope {

/// Which labellings are asked for. By default those where nothing is missing.
struct ConflictQuestion {
  bool missing_allowed = false;   ///< *missing* is a value like others
  std::vector<Index> fixed = {};  ///< per variable: the value that it has, or `no_candidate`; empty: none is fixed
  Index about = no_candidate;     ///< only the constraints and exclusions of this variable count; else all
};

/// Constraints and exclusions that cannot be met together.
struct ConflictSet {
  /// What is known of the set.
  enum class Status : std::uint8_t {
    none,      ///< all can be met
    smallest,  ///< no smaller set conflicts
    minimal,   ///< all but any one of it can be met; out of time before smaller ones were ruled out
    reduced,   ///< conflicts; out of time before it was minimal
    unknown    ///< out of time before it was known whether there is a conflict
  };
  Status status = Status::unknown;                       ///< how far it was proven
  std::vector<Index> constraints = {};                   ///< of the problem, ascending
  std::vector<std::pair<Index, Index>> exclusions = {};  ///< of two variables: their candidates share vertices

  /// Whether there is a conflict, as far as is known.
  bool conflicts() const { return status != Status::none && status != Status::unknown; }
  /// Of constraints and exclusions.
  std::size_t size() const { return constraints.size() + exclusions.size(); }
};

/// The smallest conflicting set, by implicit hitting sets: a set of items that hits the complement of every set that
/// can be met is tried; where it can be met, what cannot be added to it is one more complement to hit [Ignatiev2015].
/// Values of infinite cost are out beforehand: where no item is needed the set is empty. A constraint is not blamed for
/// candidates that exclude each other (`allowed_apart`).
///
/// \pre `check(problem)`
ConflictSet smallest_conflict(const LabelingProblem& problem, const ConflictQuestion& question, Deadline& deadline);

/// "'r1', 'r4' and the exclusion of 'rim' and 'bottom'"
std::string in_words(const LabelingProblem& problem, const ConflictSet& set);

/// Adds it to an outcome as a fact named after its status. Takes a tenth of the request's time at most.
void add_conflict_fact(const LabelingProblem& problem, const ConflictQuestion& question, const LabelingRequest& request,
                       const Deadline& so_far, const Context& context, LabelingOutcome& outcome);

}  // namespace toposcope
