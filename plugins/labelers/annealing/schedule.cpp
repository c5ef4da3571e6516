// SPDX-License-Identifier: BSD-3-Clause
#include "schedule.h"

#include <algorithm>
#include <cmath>

namespace toposcope::annealing {

std::vector<Index> random_values(const CostTables& tables, Random& random) {
  std::vector<Index> values(tables.problem().variables.size());
  for (Index v = 0; v < values.size(); ++v) {
    const auto allowed = tables.allowed(v);
    values[v] = static_cast<Index>(allowed[random.below(allowed.size())] - tables.offset(v));
  }
  return values;
}

Schedule make_schedule(const CostTables& tables, const ConditionalCosts& optimum) {
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
