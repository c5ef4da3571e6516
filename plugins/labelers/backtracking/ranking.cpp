// SPDX-License-Identifier: BSD-3-Clause
#include "ranking.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace toposcope::backtracking {

bool Ranked::operator<(const Ranked& other) const {
  return std::tie(violation, labeling.cost, labeling.values) <
         std::tie(other.violation, other.labeling.cost, other.labeling.values);
}

RankedList::RankedList(std::size_t capacity, double within, double cost_limit)
    : capacity_(std::max<std::size_t>(1, capacity)), within_(within), cost_limit_(cost_limit) {}

void RankedList::offer(const Ranked& ranked) {
  if (!(ranked.labeling.cost <= cost_limit())) return;
  const auto at = std::lower_bound(list_.begin(), list_.end(), ranked);
  if (at != list_.end() && at->labeling.values == ranked.labeling.values) return;
  list_.insert(at, ranked);
  while (list_.size() > capacity_ || list_.back().labeling.cost > cost_limit()) list_.pop_back();
}

double RankedList::cost_limit() const {
  const double least = list_.empty() ? forbidden : list_.front().labeling.cost + within_;
  return std::min({least, cost_limit_, std::numeric_limits<double>::max()});
}

bool RankedList::hopeless(double violation, double violation_slack, double cost, double cost_slack) const {
  if (!(cost <= cost_limit() + cost_slack)) return true;
  if (list_.size() < capacity_) return false;
  const Ranked& worst = list_.back();
  const bool costlier = cost > worst.labeling.cost + cost_slack;
  return violation > worst.violation + violation_slack || (costlier && violation >= worst.violation - violation_slack);
}

Ranked ranked(const LabelingProblem& problem, std::span<const Index> values, bool by_violation) {
  return {by_violation ? violation_of(problem, values) : 0, {{values.begin(), values.end()}, cost_of(problem, values)}};
}

Counter::Counter(const LabelingProblem& problem, bool by_violation, RankedList& list)
    : problem_(problem), by_violation_(by_violation), list_(list) {}

void Counter::order(Index variable, std::vector<Index>& values) {
  order_by_cost(problem_.variables[variable], values);
}

bool Counter::solution(std::span<const Index> values) {
  ++count_;
  list_.offer(ranked(problem_, values, by_violation_));
  return true;
}

BranchAndBound::BranchAndBound(const CrispNetwork& network, const Objective& cost, const Objective* violation,
                               RankedList& list)
    : network_(network),
      cost_objective_(cost),
      cost_(cost, network),
      violation_slack_(violation == nullptr ? 0 : violation->slack),
      by_violation_(violation != nullptr),
      violation_(violation == nullptr ? cost : *violation, network),
      list_(list) {}

void BranchAndBound::order(Index variable, std::vector<Index>& values) {
  const double cost_rest = cost_.bound(*domains_, variable);
  const double violation_rest = by_violation_ ? violation_.bound(*domains_, variable) : 0;
  children_.clear();
  for (const Index value : values) {
    const double cost = cost_rest + cost_.of(variable, value);
    const double violation = by_violation_ ? violation_rest + violation_.of(variable, value) : 0;
    if (!hopeless(violation, cost)) children_.push_back({violation, cost, value});
  }
  std::sort(children_.begin(), children_.end());
  values.clear();
  for (const Child& child : children_) values.push_back(child.value);
}

bool BranchAndBound::enter(Index variable, Index value) {
  cost_.enter(*domains_, variable, value);
  if (by_violation_) violation_.enter(*domains_, variable, value);
  return !hopeless(by_violation_ ? violation_.bound(*domains_) : 0, cost_.bound(*domains_));
}

void BranchAndBound::leave(Index) {
  cost_.leave();
  if (by_violation_) violation_.leave();
}

bool BranchAndBound::solution(std::span<const Index> values) {
  list_.offer(ranked(network_.problem(), values, by_violation_));
  return true;
}

bool BranchAndBound::hopeless(double violation, double cost) const {
  return list_.hopeless(violation, violation_slack_, cost + network_.problem().constant, cost_objective_.slack);
}

}  // namespace toposcope::backtracking
