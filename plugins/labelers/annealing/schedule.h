// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Random numbers that are the same with every standard library, and temperatures read off the problem's own costs.

#include <cstdint>
#include <random>
#include <vector>

#include "toposcope/labeling/local_search.h"
#include "toposcope/system/random.h"

namespace toposcope::annealing {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// \param n  below 2^32
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(((engine_() >> 32) * n) >> 32); }
  /// In (0, 1].
  double positive() { return uniform_open_closed(engine_()); }

 private:
  std::mt19937_64 engine_;
};

/// \return values whose own costs are finite. \pre every variable has one
std::vector<Index> random_values(const CostTables& tables, Random& random);

struct Schedule {
  double start = 1, end = 1;  ///< temperatures, in the unit of cost
  bool hard_only = false;     ///< no cost but 0 and infinite
  double penalty = 1;         ///< what a broken constraint or exclusion counts, in the unit of cost
};

/// From a local optimum: the penalty is the most that one change could gain or lose by finite costs alone; the start
/// temperature an eighth of the mean of all changes for the worse; the end a quarter of the gap from a variable's value
/// to its second best, at the lower quartile of the variables, and at most half the start. (Hotter starts spend time
/// where nothing is decided: on planted problems an eighth reached the best as often as the mean itself, in an eighth
/// of the time.)
Schedule make_schedule(const CostTables& tables, const ConditionalCosts& optimum);

}  // namespace toposcope::annealing
