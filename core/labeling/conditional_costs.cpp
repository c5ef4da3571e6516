// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "cost_tables.h"

namespace toposcope {
namespace {

double finite(double cost) {
  return cost < forbidden ? cost : 0;
}

std::int32_t infinite(double cost) {
  return cost < forbidden ? 0 : 1;
}

template <class Table, class Sum>
void add(const Table* before, const Table* after, Sum* sums, std::size_t count) {
  for (std::size_t a = 0; a < count; ++a) sums[a] += after[a] - before[a];
}

struct Scope {
  std::size_t base = 0;  ///< entry with the digits of the two places left at 0
  std::size_t own_stride = 1, other_stride = 1;
};

// Where in the table the other variables' values point, with two places left open.
Scope open_places(const LabelingProblem& problem, const LabelingConstraint& constraint, std::span<const Index> values,
                  std::size_t own, std::size_t other) {
  Scope scope;
  std::size_t stride = 1;
  for (std::size_t k = constraint.scope.size(); k-- > 0;) {
    if (k == own)
      scope.own_stride = stride;
    else if (k == other)
      scope.other_stride = stride;
    else
      scope.base += stride * values[constraint.scope[k]];
    stride *= problem.variables[constraint.scope[k]].domain();
  }
  return scope;
}

}  // namespace

/// What is counted beside the costs.
struct ConditionalCosts::State {
  explicit State(const CostTables::State& of)
      : tables(of), entries(of.positions()), used(of.problem.candidate_count), users(of.problem.candidate_count) {}

  std::size_t at(Index v, Index value) const { return tables.offsets[v] + value; }
  void use(Index v, Index value, std::int32_t sign);
  /// Whether a variable's own candidate is among those that the candidate conflicts with.
  bool own_conflict(Index v, Index own_value, Index candidate) const {
    const Index own = tables.candidates[at(v, own_value)];
    return own != no_candidate && tables.problem.conflict(own, candidate);
  }
  std::int32_t excluders(Index v, Index own_value, Index value) const {
    const Index candidate = tables.candidates[at(v, value)];
    if (candidate == no_candidate || used[candidate] == 0) return 0;
    return used[candidate] - (own_conflict(v, own_value, candidate) ? 1 : 0);
  }
  std::int32_t broken(Index v, Index own_value, Index value) const {
    return entries[at(v, value)] + excluders(v, own_value, value);
  }
  void move_wide(Index v, Index from, Index to, std::span<const Index> values, std::span<double> costs);

  const CostTables::State& tables;
  std::vector<std::int32_t> entries;  ///< by position: its forbidden entries given the others
  std::vector<std::int32_t> used;     ///< by candidate: variables whose candidates conflict with it
  std::vector<std::uint64_t> users;   ///< by candidate: sum of those variables
};

ConditionalCosts::ConditionalCosts(const CostTables& tables)
    : tables_(tables),
      values_(tables.problem().variables.size()),
      costs_(tables.state().positions()),
      state_(std::make_unique<State>(tables.state())) {}
ConditionalCosts::~ConditionalCosts() = default;

void ConditionalCosts::State::use(Index v, Index value, std::int32_t sign) {
  const Index candidate = tables.candidates[at(v, value)];
  if (candidate == no_candidate) return;
  const std::uint64_t user = sign > 0 ? std::uint64_t{v} : std::uint64_t{0} - v;
  for (const Index other : tables.conflicts_of(candidate)) {
    used[other] += sign;
    users[other] += user;
  }
}

void ConditionalCosts::reset(std::span<const Index> values) {
  const LabelingProblem& problem = tables_.problem();
  State& state = *state_;
  values_.assign(values.begin(), values.end());
  for (std::size_t p = 0; p < costs_.size(); ++p) {
    costs_[p] = finite(state.tables.unary[p]);
    state.entries[p] = infinite(state.tables.unary[p]);
  }
  std::fill(state.used.begin(), state.used.end(), 0);
  std::fill(state.users.begin(), state.users.end(), 0);
  cost_ = problem.constant;
  broken_ = 0;
  // Twice the exclusions, once from each side; entries with the constraints' own tables.
  for (Index v = 0; v < values_.size(); ++v) {
    cost_ += costs_[state.at(v, values_[v])];
    broken_ += state.entries[state.at(v, values_[v])];
    state.use(v, values_[v], 1);
  }
  std::int64_t excluded_twice = 0;
  for (Index v = 0; v < values_.size(); ++v) excluded_twice += excluders(v, values_[v]);
  broken_ += excluded_twice / 2;
  for (const LabelingConstraint& constraint : problem.constraints) {
    if (constraint.scope.size() < 2) continue;
    const double now = constraint.costs[table_entry(problem, constraint, values_)];
    cost_ += finite(now);
    broken_ += now == forbidden;
    for (std::size_t k = 0; k < constraint.scope.size(); ++k) {
      const Index v = constraint.scope[k];
      const Scope scope = open_places(problem, constraint, values_, k, k);
      for (Index a = 0; a < problem.variables[v].domain(); ++a) {
        const double cost = constraint.costs[scope.base + a * scope.own_stride];
        costs_[state.at(v, a)] += finite(cost);
        state.entries[state.at(v, a)] += infinite(cost);
      }
    }
  }
}

std::int32_t ConditionalCosts::broken_change(Index v, Index value) const {
  return state_->broken(v, values_[v], value) - state_->broken(v, values_[v], values_[v]);
}

std::int32_t ConditionalCosts::excluders(Index v, Index value) const {
  return state_->excluders(v, values_[v], value);
}

Index ConditionalCosts::sole_opponent(Index v, Index value) const {
  const State& state = *state_;
  if (state.broken(v, values_[v], value) != 1) return v;
  if (state.entries[state.at(v, value)] == 0) {
    const Index candidate = state.tables.candidates[state.at(v, value)];
    return static_cast<Index>(state.users[candidate] - (state.own_conflict(v, values_[v], candidate) ? v : 0));
  }
  for (const CostTables::State::Pair& pair : state.tables.pairs[v])
    if (pair.entries != nullptr && pair.entries[value * tables_.domain(pair.other) + values_[pair.other]] != 0)
      return pair.other;
  return v;
}

void ConditionalCosts::State::move_wide(Index v, Index from, Index to, std::span<const Index> values,
                                        std::span<double> costs) {
  const LabelingProblem& problem = tables.problem;
  for (const CostTables::State::Wide& wide : tables.wide[v]) {
    const LabelingConstraint& constraint = problem.constraints[wide.constraint];
    for (std::size_t k = 0; k < constraint.scope.size(); ++k) {
      if (k == wide.place) continue;
      const Index other = constraint.scope[k];
      const Scope scope = open_places(problem, constraint, values, wide.place, k);
      const double* before = constraint.costs.data() + scope.base + from * scope.own_stride;
      const double* after = constraint.costs.data() + scope.base + to * scope.own_stride;
      const Index domain = problem.variables[other].domain();
      for (Index a = 0; a < domain; ++a) {
        const double old_cost = before[a * scope.other_stride], new_cost = after[a * scope.other_stride];
        costs[at(other, a)] += finite(new_cost) - finite(old_cost);
        entries[at(other, a)] += infinite(new_cost) - infinite(old_cost);
      }
    }
  }
}

void ConditionalCosts::assign(Index v, Index value) {
  const Index from = values_[v];
  if (value == from) return;
  State& state = *state_;
  cost_ += cost_change(v, value);
  broken_ += broken_change(v, value);
  for (const CostTables::State::Pair& pair : state.tables.pairs[v]) {
    const std::size_t first = tables_.offset(pair.other), domain = tables_.domain(pair.other);
    if (pair.costs != nullptr)
      add(pair.costs + from * domain, pair.costs + value * domain, costs_.data() + first, domain);
    if (pair.entries != nullptr)
      add(pair.entries + from * domain, pair.entries + value * domain, state.entries.data() + first, domain);
  }
  state.move_wide(v, from, value, values_, costs_);
  state.use(v, from, -1);
  values_[v] = value;
  state.use(v, value, 1);
}

bool descend(const CostTables& tables, ConditionalCosts& costs, Deadline& deadline) {
  const auto variables = static_cast<Index>(tables.problem().variables.size());
  Index unchanged = 0;  // variables in a row that had nothing better
  for (Index v = 0; unchanged < variables; v = v + 1 < variables ? v + 1 : 0) {
    if (deadline.reached()) return false;
    Index best = costs.values()[v];
    std::int32_t least_broken = 0;
    double least = -tables.slack();
    for (const std::uint32_t position : tables.allowed(v)) {
      const auto value = static_cast<Index>(position - tables.offset(v));
      const std::int32_t broken = costs.broken_change(v, value);
      const double cost = costs.cost_change(v, value);
      if (broken > least_broken || (broken == least_broken && cost >= least)) continue;
      best = value;
      least_broken = broken;
      least = cost;
    }
    unchanged = best == costs.values()[v] ? unchanged + 1 : 1;
    costs.assign(v, best);
  }
  return true;
}

bool offer_neighbours(const CostTables& tables, const ConditionalCosts& costs, BestLabelings& best,
                      Deadline& deadline) {
  const LabelingProblem& problem = tables.problem();
  Labeling labeling{costs.values(), 0};
  const auto offer = [&] {
    labeling.cost = cost_of(problem, labeling.values);
    best.offer(labeling);
  };
  if (costs.broken() == 0) offer();
  for (const std::uint32_t position : tables.allowed()) {
    const Index v = tables.owner(position);
    const auto value = static_cast<Index>(position - tables.offset(v));
    if (value == costs.values()[v] || costs.broken() + costs.broken_change(v, value) != 0) continue;
    if (costs.cost() + costs.cost_change(v, value) > best.limit() + tables.slack()) continue;
    labeling.values[v] = value;
    offer();
    labeling.values[v] = costs.values()[v];
    if (deadline.reached()) return false;  // each is summed anew, over all variables and constraints
  }
  return true;
}

}  // namespace toposcope
