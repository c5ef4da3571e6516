// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The k best consistent labellings, and the branch and bound that finds them.

#include <algorithm>
#include <tuple>
#include <vector>

#include "objective.h"
#include "toposcope/labeling/crisp_search.h"

namespace toposcope::backtracking {

/// A labelling with what it is ranked by; ties are broken by the values.
struct Ranked {
  double violation = 0;  ///< 0 where the rank is the cost alone
  Labeling labeling;
  bool operator<(const Ranked& other) const {
    return std::tie(violation, labeling.cost, labeling.values) <
           std::tie(other.violation, other.labeling.cost, other.labeling.values);
  }
};

/// The k best of those offered, best first. Offering one twice keeps it once.
class RankedList {
 public:
  RankedList(std::size_t capacity, double within, double cost_limit)
      : capacity_(std::max<std::size_t>(1, capacity)), within_(within), cost_limit_(cost_limit) {}

  void offer(const Ranked& ranked) {
    if (!(ranked.labeling.cost <= cost_limit())) return;
    const auto at = std::lower_bound(list_.begin(), list_.end(), ranked);
    if (at != list_.end() && at->labeling.values == ranked.labeling.values) return;
    list_.insert(at, ranked);
    while (list_.size() > capacity_ || list_.back().labeling.cost > cost_limit()) list_.pop_back();
  }
  double cost_limit() const {
    const double least = list_.empty() ? forbidden : list_.front().labeling.cost + within_;
    return std::min({least, cost_limit_, std::numeric_limits<double>::max()});
  }
  /// True where nothing with these bounds can enter.
  bool hopeless(double violation, double violation_slack, double cost, double cost_slack) const {
    if (!(cost <= cost_limit() + cost_slack)) return true;
    if (list_.size() < capacity_) return false;
    const Ranked& worst = list_.back();
    const bool costlier = cost > worst.labeling.cost + cost_slack;
    return violation > worst.violation + violation_slack ||
           (costlier && violation >= worst.violation - violation_slack);
  }
  const std::vector<Ranked>& list() const { return list_; }

 private:
  std::size_t capacity_;
  double within_, cost_limit_;
  std::vector<Ranked> list_;
};

/// Ranks a labelling by its sums in the problem's order, the same by whichever path it was found.
inline Ranked ranked(const LabelingProblem& problem, std::span<const Index> values, bool by_violation) {
  return {by_violation ? violation_of(problem, values) : 0, {{values.begin(), values.end()}, cost_of(problem, values)}};
}

/// Visits every consistent labelling, the values of least cost first.
class Counter final : public CrispVisitor {
 public:
  Counter(const LabelingProblem& problem, bool by_violation, RankedList& list)
      : problem_(problem), by_violation_(by_violation), list_(list) {}

  void order(Index variable, std::vector<Index>& values) override {
    order_by_cost(problem_.variables[variable], values);
  }
  bool enter(Index, Index) override { return true; }
  void leave(Index) override {}
  bool solution(std::span<const Index> values) override {
    ++count_;
    list_.offer(ranked(problem_, values, by_violation_));
    return true;
  }
  std::uint64_t count() const { return count_; }

 private:
  const LabelingProblem& problem_;
  bool by_violation_;
  RankedList& list_;
  std::uint64_t count_ = 0;
};

/// Leaves out what cannot enter the list.
class BranchAndBound final : public CrispVisitor {
 public:
  /// \param violation  null where the rank is the cost alone
  BranchAndBound(const CrispNetwork& network, const Objective& cost, const Objective* violation, RankedList& list)
      : network_(network),
        cost_objective_(cost),
        cost_(cost, network),
        violation_slack_(violation == nullptr ? 0 : violation->slack),
        by_violation_(violation != nullptr),
        violation_(violation == nullptr ? cost : *violation, network),
        list_(list) {}

  void follow(const CrispDomains& domains) { domains_ = &domains; }

  void order(Index variable, std::vector<Index>& values) override {
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

  bool enter(Index variable, Index value) override {
    cost_.enter(*domains_, variable, value);
    if (by_violation_) violation_.enter(*domains_, variable, value);
    return !hopeless(by_violation_ ? violation_.bound(*domains_) : 0, cost_.bound(*domains_));
  }

  void leave(Index) override {
    cost_.leave();
    if (by_violation_) violation_.leave();
  }

  bool solution(std::span<const Index> values) override {
    list_.offer(ranked(network_.problem(), values, by_violation_));
    return true;
  }

 private:
  struct Child {
    double violation, cost;
    Index value;
    bool operator<(const Child& o) const {
      return std::tie(violation, cost, value) < std::tie(o.violation, o.cost, o.value);
    }
  };

  bool hopeless(double violation, double cost) const {
    return list_.hopeless(violation, violation_slack_, cost + network_.problem().constant, cost_objective_.slack);
  }

  const CrispNetwork& network_;
  const Objective& cost_objective_;
  Bounds cost_;
  double violation_slack_;
  bool by_violation_;
  Bounds violation_;
  RankedList& list_;
  const CrispDomains* domains_ = nullptr;
  std::vector<Child> children_;
};

}  // namespace toposcope::backtracking
