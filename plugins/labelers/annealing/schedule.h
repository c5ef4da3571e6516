// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Random numbers that are the same with every standard library, and temperatures read off the problem's own costs.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "toposcope/labeling/local_search.h"

namespace toposcope::annealing {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// \param n  below 2^32
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(((engine_() >> 32) * n) >> 32); }
  /// In (0, 1].
  double positive() { return static_cast<double>((engine_() >> 11) + 1) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

/// Steele, Lea and Flood's finaliser: nearby numbers become unrelated ones.
inline std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// \return values whose own costs are finite. \pre every variable has one
inline std::vector<Index> random_values(const CostTables& tables, Random& random) {
  std::vector<Index> values(tables.problem().variables.size());
  for (Index v = 0; v < values.size(); ++v) {
    const auto allowed = tables.allowed(v);
    values[v] = static_cast<Index>(allowed[random.below(allowed.size())] - tables.offset(v));
  }
  return values;
}

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
inline Schedule make_schedule(const CostTables& tables, const ConditionalCosts& optimum) {
  const auto variables = static_cast<Index>(tables.problem().variables.size());
  Schedule schedule;
  schedule.penalty = 0;
  for (const std::uint32_t position : tables.allowed()) {
    const Index v = tables.owner(position);
    const double change = std::abs(optimum.cost_change(v, static_cast<Index>(position - tables.offset(v))));
    schedule.penalty = std::max(schedule.penalty, change);
  }
  schedule.hard_only = !(schedule.penalty > tables.slack());
  if (schedule.hard_only) schedule.penalty = 1;
  double sum = 0, count = 0;
  std::vector<double> gaps;
  for (Index v = 0; v < variables; ++v) {
    double gap = forbidden;
    for (const std::uint32_t position : tables.allowed(v)) {
      const auto value = static_cast<Index>(position - tables.offset(v));
      const double change = optimum.cost_change(v, value) + schedule.penalty * optimum.broken_change(v, value);
      if (!(change > tables.slack())) continue;
      sum += std::min(change, schedule.penalty);
      ++count;
      gap = std::min(gap, change);
    }
    if (gap < forbidden) gaps.push_back(gap);
  }
  if (gaps.empty()) return schedule;
  const auto quarter = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 4);
  std::nth_element(gaps.begin(), quarter, gaps.end());
  schedule.start = sum / count / 8;
  schedule.end = std::min(*quarter / 4, schedule.start / 2);
  return schedule;
}

}  // namespace toposcope::annealing
