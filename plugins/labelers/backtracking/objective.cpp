// SPDX-License-Identifier: BSD-3-Clause
#include "objective.h"

#include <algorithm>
#include <cmath>

namespace toposcope::backtracking {

namespace {

constexpr std::size_t poll_entries = 4096;

// Violation of a table entry as the rank `violation` counts it. A relation left untested by a missing feature counts
// 1, the worst that a satisfied one can be: otherwise the labelling that finds nothing would satisfy best.
double counted_violation(const LabelingConstraint& constraint, bool untested, std::size_t entry) {
  if (untested) return 1;
  return constraint.violations.empty() ? 0 : static_cast<double>(constraint.violations[entry]);
}

bool fill(Part& part, const LabelingProblem& problem, const LabelingConstraint& constraint, bool violations,
          Deadline& deadline) {
  part = {constraint.scope, std::vector<std::size_t>(constraint.scope.size(), 1),
          std::vector<double>(constraint.costs.size())};
  for (std::size_t k = part.scope.size() - 1; k-- > 0;)
    part.strides[k] = part.strides[k + 1] * problem.variables[part.scope[k + 1]].domain();
  std::vector<Index> digits(part.scope.size(), 0);
  std::size_t entry = 0;
  do {
    if (entry % poll_entries == 0 && deadline.reached()) return false;
    bool untested = false;
    for (std::size_t k = 0; k < digits.size(); ++k)
      untested = untested || problem.variables[part.scope[k]].missing(digits[k]);
    part.table[entry] = !allowed(constraint, entry) ? forbidden
                        : violations                ? counted_violation(constraint, untested, entry)
                                                    : constraint.costs[entry];
    ++entry;
  } while (next_entry(problem, constraint, digits));
  return true;
}

std::size_t stride_of(const Part& part, Index variable) {
  return part.strides[static_cast<std::size_t>(std::find(part.scope.begin(), part.scope.end(), variable) -
                                               part.scope.begin())];
}

}  // namespace

double violation_of(const LabelingProblem& problem, std::span<const Index> values) {
  double sum = 0;
  for (const LabelingConstraint& constraint : problem.constraints) {
    bool untested = false;
    for (const Index v : constraint.scope) untested = untested || problem.variables[v].missing(values[v]);
    sum += counted_violation(constraint, untested, table_entry(problem, constraint, values));
  }
  return sum;
}

bool Objective::make(const CrispNetwork& network, bool violations, std::span<const Index> order, Deadline& deadline) {
  const LabelingProblem& problem = network.problem();
  unary.assign(network.offset(network.variables()), 0);
  parts_of.assign(network.variables(), {});
  std::vector<Index> rank(order.size());
  for (Index at = 0; at < order.size(); ++at) rank[order[at]] = at;
  double magnitude = 1;
  for (Index v = 0; v < network.variables() && !violations; ++v)
    for (Index value = 0; value < network.domain(v); ++value) {
      const double cost = problem.variables[v].costs[value];
      unary[network.offset(v) + value] = cost;
      if (cost < forbidden) magnitude += std::abs(cost);
    }
  for (const LabelingConstraint& constraint : problem.constraints) {
    Part part;
    if (!fill(part, problem, constraint, violations, deadline)) return false;
    double largest = 0;
    for (const double value : part.table)
      if (value < forbidden) largest = std::max(largest, std::abs(value));
    magnitude += largest;
    if (part.scope.size() == 1)
      for (Index value = 0; value < part.table.size(); ++value)
        unary[network.offset(part.scope[0]) + value] += part.table[value];
    else
      parts.push_back(std::move(part));
  }
  slack = 1e-12 * magnitude;
  for (Index p = 0; p < parts.size(); ++p)
    for (const Index v : parts[p].scope) parts_of[v].push_back(p);
  return direct(network, order, rank, deadline);
}

// From the last variable to the first: what its values cost is shared out among the constraints that end at it, and
// what these then cost at least is moved to the values of their first variable (directional arc consistency). No
// labelling's sum changes.
bool Objective::direct(const CrispNetwork& network, std::span<const Index> order, std::span<const Index> rank,
                       Deadline& deadline) {
  std::vector<std::vector<Index>> ending(order.size());
  const auto by_rank = [&](Index a, Index b) { return rank[a] < rank[b]; };
  for (Index p = 0; p < parts.size(); ++p)
    ending[rank[*std::max_element(parts[p].scope.begin(), parts[p].scope.end(), by_rank)]].push_back(p);
  for (Index at = static_cast<Index>(order.size()); at-- > 0;) {
    const Index last = order[at];
    if (ending[at].empty()) continue;
    const double share = 1 / static_cast<double>(ending[at].size());
    double* own = unary.data() + network.offset(last);
    for (const Index p : ending[at]) {
      Part& part = parts[p];
      const Index first = *std::min_element(part.scope.begin(), part.scope.end(), by_rank);
      const std::size_t from = stride_of(part, last), to = stride_of(part, first);
      std::vector<double> least(network.domain(first), forbidden);
      const auto of_last = [&](std::size_t entry) { return entry / from % network.domain(last); };
      const auto of_first = [&](std::size_t entry) { return entry / to % least.size(); };
      for (std::size_t entry = 0; entry < part.table.size(); ++entry) {
        if (entry % poll_entries == 0 && deadline.reached()) return false;
        part.table[entry] += share * own[of_last(entry)];
        double& low = least[of_first(entry)];
        low = std::min(low, part.table[entry]);
      }
      double* target = unary.data() + network.offset(first);
      for (std::size_t value = 0; value < least.size(); ++value) target[value] += least[value];
      for (std::size_t entry = 0; entry < part.table.size(); ++entry)
        if (least[of_first(entry)] < forbidden) part.table[entry] -= least[of_first(entry)];
    }
    for (std::size_t value = 0; value < network.domain(last); ++value)
      if (own[value] < forbidden) own[value] = 0;
  }
  return true;
}

Bounds::Bounds(const Objective& objective, const CrispNetwork& network)
    : objective_(objective), network_(network), levels_{objective.unary}, sums_{0}, values_(network.variables(), 0) {}

double Bounds::bound(const CrispDomains& domains, Index without) const {
  double total = sums_[depth_];
  for (Index v = 0; v < network_.variables(); ++v)
    if (v != without && !domains.assigned(v)) total += least(domains, v);
  return total;
}

double Bounds::least(const CrispDomains& domains, Index variable) const {
  const double* level = levels_[depth_].data() + network_.offset(variable);
  double low = forbidden;
  for_each_value(domains.domain(variable), [&](Index value) { low = std::min(low, level[value]); });
  return low;
}

void Bounds::enter(const CrispDomains& domains, Index variable, Index value) {
  if (levels_.size() == depth_ + 1) {
    levels_.emplace_back(levels_[0].size());
    sums_.push_back(0);
  }
  std::copy(levels_[depth_].begin(), levels_[depth_].end(), levels_[depth_ + 1].begin());
  sums_[depth_ + 1] = sums_[depth_] + levels_[depth_][network_.offset(variable) + value];
  ++depth_;
  values_[variable] = value;
  for (const Index p : objective_.parts_of[variable]) {
    const Part& part = objective_.parts[p];
    std::size_t entry = 0, stride = 0, left = 0;
    Index last = 0;
    for (std::size_t k = 0; k < part.scope.size(); ++k) {
      const Index v = part.scope[k];
      if (domains.assigned(v)) {
        entry += part.strides[k] * values_[v];
      } else {
        ++left;
        last = v;
        stride = part.strides[k];
      }
    }
    if (left != 1) continue;
    double* level = levels_[depth_].data() + network_.offset(last);
    for (Index v = 0; v < network_.domain(last); ++v) level[v] += part.table[entry + stride * v];
  }
}

}  // namespace toposcope::backtracking
