// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What CostTables hides.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "toposcope/labeling/local_search.h"

namespace toposcope {

/// Both orientations of a pair's costs, what is forbidden apart, and for each candidate those that it excludes.
struct CostTables::State {
 public:
  State(const LabelingProblem& problem, Deadline& deadline);

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

  std::size_t positions() const { return offsets.back(); }
  std::span<const Index> conflicts_of(Index candidate) const {
    return {conflicts.data() + conflict_offsets[candidate], conflicts.data() + conflict_offsets[candidate + 1]};
  }

  const LabelingProblem& problem;
  bool complete = false;
  double lower_bound = -forbidden, slack = 0;
  std::vector<std::size_t> offsets, allowed_offsets, conflict_offsets;
  std::vector<Index> owners;
  std::vector<Index> candidates;  ///< by position: row of the conflict table, or `no_candidate`
  std::vector<Index> conflicts;
  std::vector<std::uint32_t> allowed;
  std::vector<double> unary;  ///< by position: own cost and that of constraints over the variable alone
  std::vector<std::vector<Pair>> pairs;
  std::vector<std::vector<Wide>> wide;

 private:
  void read_variables();
  bool read_constraints(Deadline& deadline);
  bool read_pairs(Deadline& deadline);
  Pair see_pair(Index constraint, bool second);
  bool list_conflicts(Deadline& deadline);

  std::vector<bool> forbids_, weighs_;  ///< by constraint: some cost is infinite; is finite and not 0
  std::vector<std::unique_ptr<double[]>> own_costs_;
  std::vector<std::unique_ptr<std::uint8_t[]>> own_entries_;
};

}  // namespace toposcope
