// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Depth-first branch and bound over the tree of labellings, with forward checking: every assignment at once adds what
// it costs the values of the features still to come, and strikes those that are now forbidden.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "tables.h"
#include "toposcope/context.h"

namespace toposcope::tree_search {

/// Says when to stop: out of time, or cancelled.
class Stop {
 public:
  Stop(double time_limit_s, Context& context) : context_(context), begin_(Clock::now()), limit_s_(time_limit_s) {}
  bool reached() {
    if (!reached_)
      reached_ = context_.cancelled() || std::chrono::duration<double>(Clock::now() - begin_).count() >= limit_s_;
    return reached_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Context& context_;
  Clock::time_point begin_;
  double limit_s_;
  bool reached_ = false;
};

/// Which labellings a search visits and how it ranks them.
struct Rules {
  bool by_violation = false;      ///< rank by the sum of violations, then by cost; else by cost
  std::optional<Index> missing;   ///< exactly so many features missing
  double cost_limit = forbidden;  ///< costlier ones are left out
};

/// A labelling with what it is ranked by; ties are broken by the values, in the problem's order.
struct Ranked {
  double violation = 0;
  Labeling labeling;
  bool operator<(const Ranked& other) const {
    return std::tie(violation, labeling.cost, labeling.values) <
           std::tie(other.violation, other.labeling.cost, other.labeling.values);
  }
};

/// Sums of exp(reference - cost): in all, and per value of each variable (positions as in Objective::root).
struct Sums {
  double total = 0;
  std::vector<double> values;
  std::uint64_t labelings = 0;
};

class DepthFirst {
 public:
  DepthFirst(const Tables& tables, Stop& stop)
      : tables_(tables),
        stop_(stop),
        width_(tables.offsets.back()),
        values_(tables.depths()),
        cost_levels_(tables.depths() * width_),
        violation_levels_(tables.violation.root.empty() ? 0 : cost_levels_.size()),
        cost_rest_(tables.depths()),
        violation_rest_(tables.depths()),
        children_(tables.depths()),
        conflicts_(width_) {
    for (Index depth = 0; depth < tables.depths(); ++depth) children_[depth].reserve(tables.domain(depth));
    offered_.labeling.values.resize(tables.depths());
  }

  /// The k best labellings, best first. \return false when stopped before it was sure
  bool best(const Rules& rules, std::size_t k, std::vector<Ranked>& found) {
    begin(rules);
    capacity_ = k;
    heap_.clear();
    open_bound_ = forbidden;
    const bool finished = !root() || descend(0, 0, 0, 0);
    std::sort_heap(heap_.begin(), heap_.end());
    found = std::move(heap_);
    return finished;
  }

  /// Sums over all labellings that the rules admit. \return false when stopped
  bool sum(const Rules& rules, double reference, Sums& sums) {
    begin(rules);
    reference_ = reference;
    sums_ = {0, std::vector<double>(width_, 0), 0};
    stopped_ = false;
    if (root()) sums_.total = add_up(0, 0, 0);
    sums = std::move(sums_);
    return !stopped_;
  }

  std::uint64_t nodes() const { return nodes_; }
  /// Least cost that a labelling can have which the last `best` did not get to see.
  double open_bound() const { return open_bound_; }

 private:
  struct Child {
    double violation, cost;  ///< bounds
    Index value;
    bool operator<(const Child& o) const {
      return std::tie(violation, cost, value) < std::tie(o.violation, o.cost, o.value);
    }
  };
  struct Conflicts {
    bool known = false;
    std::vector<std::size_t> positions;  ///< of the later candidates that conflict, found when first asked for
  };

  double* costs(Index depth) { return cost_levels_.data() + depth * width_; }
  double* violations(Index depth) { return violation_levels_.data() + depth * width_; }

  void begin(const Rules& rules) {
    rules_ = rules;
    // Finite even where the rules set no limit: what is forbidden costs infinitely much.
    limit_ = std::min(rules.cost_limit + tables_.cost.slack, std::numeric_limits<double>::max());
  }

  bool root() {
    std::copy(tables_.cost.root.begin(), tables_.cost.root.end(), costs(0));
    if (rules_.by_violation) std::copy(tables_.violation.root.begin(), tables_.violation.root.end(), violations(0));
    return bound(0, 0, 0);
  }

  bool allowed(Index depth, Index missing, bool is_missing) const {
    if (!rules_.missing) return true;
    return is_missing ? missing < *rules_.missing : missing + tables_.depths() - 1 - depth >= *rules_.missing;
  }

  // True where nothing with these bounds can enter the list.
  bool hopeless(double violation, double cost) const {
    if (!(cost <= limit_)) return true;
    if (heap_.size() < capacity_) return false;
    const Ranked& worst = heap_.front();
    const bool costlier = cost > worst.labeling.cost + tables_.cost.slack;
    if (!rules_.by_violation) return costlier;
    return violation > worst.violation + tables_.violation.slack ||
           (costlier && violation >= worst.violation - tables_.violation.slack);
  }

  // Bounds what the variables after `depth` add, from the tables of that level. False where one of them has no value
  // left or too many would have to be missing.
  bool bound(Index depth, Index missing, double cost_so_far) {
    double cost_rest = 0, violation_rest = 0;
    Index must_miss = 0;
    const bool none_missing = rules_.missing && missing >= *rules_.missing;
    for (Index later = depth + 1; later < tables_.depths(); ++later) {
      const std::size_t first = tables_.offsets[later], last = tables_.offsets[later + 1];
      const double* cost = costs(depth);
      double low = forbidden;
      for (std::size_t v = first + 1; v < last; ++v) low = std::min(low, cost[v]);
      must_miss += low == forbidden;
      if (!none_missing) low = std::min(low, cost[first]);
      cost_rest += low;
      if (cost_so_far + cost_rest == forbidden) return false;
      if (rules_.by_violation) violation_rest += *std::min_element(violations(depth) + first, violations(depth) + last);
    }
    cost_rest_[depth] = cost_rest;
    violation_rest_[depth] = violation_rest;
    return !rules_.missing || missing + must_miss <= *rules_.missing;
  }

  static void add(const std::vector<Increment>& due, const std::vector<Index>& values,
                  const std::vector<std::size_t>& offsets, double* level) {
    for (const Increment& increment : due) {
      const double* row = increment.row(values);
      double* to = level + offsets[increment.depth];
      const std::size_t width = offsets[increment.depth + 1] - offsets[increment.depth];
      for (std::size_t v = 0; v < width; ++v) to[v] += row[v];
    }
  }

  // Assigns a value and makes the next level: what it adds to later values, and what it excludes.
  bool assign(Index depth, Index value, Index missing, double cost_so_far) {
    values_[depth] = value;
    const std::size_t later = tables_.offsets[depth + 1];
    double* cost = costs(depth + 1);
    std::copy(costs(depth) + later, costs(depth) + width_, cost + later);
    add(tables_.cost.after[depth], values_, tables_.offsets, cost);
    if (rules_.by_violation) {
      std::copy(violations(depth) + later, violations(depth) + width_, violations(depth + 1) + later);
      add(tables_.violation.after[depth], values_, tables_.offsets, violations(depth + 1));
    }
    if (value > 0) exclude(depth, value, cost);
    return bound(depth + 1, missing, cost_so_far);
  }

  // No two features share a vertex: strikes the candidates that conflict with the one just assigned.
  void exclude(Index depth, Index value, double* cost) {
    Conflicts& conflicts = conflicts_[tables_.offsets[depth] + value];
    if (!conflicts.known) {
      conflicts.known = true;
      const Index candidate = tables_.variable(depth).candidates[value - 1];
      for (Index later = depth + 1; later < tables_.depths(); ++later) {
        const std::vector<Index>& candidates = tables_.variable(later).candidates;
        for (std::size_t k = 0; k < candidates.size(); ++k)
          if (tables_.problem.conflict(candidate, candidates[k]))
            conflicts.positions.push_back(tables_.offsets[later] + 1 + k);
      }
    }
    for (const std::size_t position : conflicts.positions) cost[position] = forbidden;
  }

  bool poll() { return (++nodes_ & 255U) != 0 || !stop_.reached(); }

  // The children of a node, most promising first; false when stopped.
  bool descend(Index depth, double violation, double cost, Index missing) {
    const Index domain = tables_.domain(depth);
    const double* value_cost = costs(depth) + tables_.offsets[depth];
    const double* value_violation = rules_.by_violation ? violations(depth) + tables_.offsets[depth] : nullptr;
    std::vector<Child>& children = children_[depth];
    children.clear();
    for (Index v = 0; v < domain; ++v) {
      const double child_cost = cost + value_cost[v] + cost_rest_[depth];
      const double child_violation = rules_.by_violation ? violation + value_violation[v] + violation_rest_[depth] : 0;
      if (allowed(depth, missing, v == 0) && !hopeless(child_violation, child_cost))
        children.push_back({child_violation, child_cost, v});
    }
    std::sort(children.begin(), children.end());
    for (std::size_t i = 0; i < children.size(); ++i) {
      const Child child = children[i];
      if (hopeless(child.violation, child.cost)) continue;
      bool going = poll();
      if (going) {
        const Index now_missing = missing + (child.value == 0);
        const double now_cost = cost + value_cost[child.value];
        if (depth + 1 == tables_.depths()) {
          values_[depth] = child.value;
          offer();
        } else if (assign(depth, child.value, now_missing, now_cost)) {
          const double now_violation = rules_.by_violation ? violation + value_violation[child.value] : 0;
          going = descend(depth + 1, now_violation, now_cost, now_missing);
          if (!going) ++i;  // it has told its own open bounds
        }
      }
      if (!going) {
        for (; i < children.size(); ++i) open_bound_ = std::min(open_bound_, children[i].cost);
        return false;
      }
    }
    return true;
  }

  // A complete labelling: its cost summed afresh in the problem's order, the same by whichever path it was found.
  void offer() {
    for (Index depth = 0; depth < tables_.depths(); ++depth)
      offered_.labeling.values[tables_.order[depth]] = values_[depth];
    const auto [violation, cost] = tables_.evaluate(offered_.labeling.values);
    offered_.labeling.cost = cost;
    offered_.violation = rules_.by_violation ? violation : 0;
    if (heap_.size() < capacity_) {
      heap_.push_back(offered_);
    } else if (offered_ < heap_.front()) {
      std::pop_heap(heap_.begin(), heap_.end());
      std::swap(heap_.back(), offered_);
    } else {
      return;
    }
    std::push_heap(heap_.begin(), heap_.end());
  }

  // Sum over the labellings below a node; adds each value's share on the way back.
  double add_up(Index depth, double cost, Index missing) {
    const std::size_t first = tables_.offsets[depth];
    const Index domain = tables_.domain(depth);
    const bool leaf = depth + 1 == tables_.depths();
    const double* value_cost = costs(depth) + first;
    double total = 0;
    for (Index v = 0; v < domain && !stopped_; ++v) {
      const double now_cost = cost + value_cost[v];
      if (!(now_cost + cost_rest_[depth] <= limit_) || !allowed(depth, missing, v == 0)) continue;
      double share = 0;
      if (leaf) {
        share = std::exp(reference_ - now_cost);
        ++sums_.labelings;
      } else {
        stopped_ = !poll();
        const Index now_missing = missing + (v == 0);
        if (!stopped_ && assign(depth, v, now_missing, now_cost)) share = add_up(depth + 1, now_cost, now_missing);
      }
      sums_.values[first + v] += share;
      total += share;
    }
    return total;
  }

  const Tables& tables_;
  Stop& stop_;
  std::size_t width_;
  Rules rules_;
  double limit_ = forbidden;
  std::vector<Index> values_;  ///< by depth
  std::vector<double> cost_levels_, violation_levels_, cost_rest_, violation_rest_;
  std::vector<std::vector<Child>> children_;
  std::vector<Conflicts> conflicts_;  ///< by position
  std::vector<Ranked> heap_;          ///< worst first
  Ranked offered_;
  std::size_t capacity_ = 0;
  double open_bound_ = forbidden;
  double reference_ = 0;
  Sums sums_;
  bool stopped_ = false;
  std::uint64_t nodes_ = 0;
};

}  // namespace toposcope::tree_search
