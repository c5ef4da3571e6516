// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "cost_tables.h"
#include "toposcope/labeling/relaxation_labeling.h"

namespace toposcope {
namespace {

double largest_finite(const LabelingProblem& problem, Deadline& deadline) {
  double found = 0;
  for (const LabelingVariable& variable : problem.variables) {
    const double least = *std::min_element(variable.costs.begin(), variable.costs.end());
    for (const double cost : variable.costs) found = std::max(found, cost < forbidden ? cost - least : 0);
  }
  for (const LabelingConstraint& constraint : problem.constraints) {
    if (deadline.reached()) break;
    for (const double cost : constraint.costs) found = std::max(found, cost < forbidden ? std::abs(cost) : 0);
  }
  return found > 0 ? found : 1;
}

}  // namespace

struct Compatibilities::State {
 public:
  State(const CostTables& tables, double saturation_cost, bool lasting, Deadline& deadline);
  Index variables() const { return static_cast<Index>(offsets.size() - 1); }
  std::optional<double> support(std::span<const double> weights, std::span<double> support, Deadline& deadline);

  bool complete = false;
  double saturation;
  std::size_t degree = 0;
  std::vector<std::size_t> offsets;

 private:
  struct Place {
    std::size_t first, count;  ///< labels of a variable
  };
  struct Table {
    std::size_t first_place, places, entry;
  };

  bool read(const CostTables& tables, Deadline& deadline);
  bool read_exclusions(const CostTables& tables, Deadline& deadline);
  double pair(const Table& table, std::span<const double> weights, std::span<double> support) const;
  double wide(const Table& table, std::span<const double> weights, std::span<double> support);
  double exclusions(std::span<const double> weights, std::span<double> support);

  std::vector<float> own_;      ///< by label: u and constraints over the variable alone
  std::vector<float> entries_;  ///< compatibilities, table after table, last place fastest
  std::vector<Place> places_;
  std::vector<Table> tables_;
  // Exclusions, by candidate: what is used, and what excludes it; own ones by label do not count.
  std::vector<Index> candidates_;
  std::vector<std::size_t> conflict_offsets_, own_conflict_offsets_;
  std::vector<Index> conflicts_;
  std::vector<std::uint32_t> own_conflicts_;
  std::vector<double> used_, excluding_;
  // Of `wide`.
  std::vector<std::size_t> digits_;
  std::vector<double> products_;
};

Compatibilities::Compatibilities(const CostTables& tables, double saturation, bool lasting, Deadline& deadline)
    : state_(std::make_unique<State>(tables, saturation, lasting, deadline)) {}
Compatibilities::~Compatibilities() = default;

bool Compatibilities::complete() const {
  return state_->complete;
}

double Compatibilities::saturation() const {
  return state_->saturation;
}

Index Compatibilities::variables() const {
  return state_->variables();
}

std::size_t Compatibilities::labels() const {
  return state_->offsets.back();
}

std::size_t Compatibilities::offset(Index v) const {
  return state_->offsets[v];
}

std::size_t Compatibilities::degree() const {
  return state_->degree;
}

std::optional<double> Compatibilities::support(std::span<const double> weights, std::span<double> support,
                                               Deadline& deadline) {
  return state_->support(weights, support, deadline);
}

Compatibilities::State::State(const CostTables& tables, double saturation_cost, bool lasting, Deadline& deadline)
    : saturation(saturation_cost > 0 ? saturation_cost : largest_finite(tables.problem(), deadline)), offsets(1, 0) {
  const LabelingProblem& problem = tables.problem();
  for (Index v = 0; v < problem.variables.size(); ++v) {
    const std::vector<double>& costs = problem.variables[v].costs;
    const double least = *std::min_element(costs.begin(), costs.end());
    for (const std::uint32_t position : tables.allowed(v)) {
      const double cost = costs[position - tables.offset(v)] - least;
      own_.push_back(lasting ? static_cast<float>(-std::min(cost / saturation, 1.0)) : 0.0F);
      candidates_.push_back(tables.state().candidates[position]);
    }
    offsets.push_back(own_.size());
  }
  std::vector<std::size_t> degrees(variables(), lasting ? 1 : 0);
  for (const LabelingConstraint& constraint : problem.constraints)
    for (const Index v : constraint.scope) ++degrees[v];
  for (const std::size_t each : degrees) degree = std::max(degree, each);
  complete = read(tables, deadline) && read_exclusions(tables, deadline);
}

bool Compatibilities::State::read(const CostTables& tables, Deadline& deadline) {
  const LabelingProblem& problem = tables.problem();
  std::size_t most_places = 0;
  std::vector<std::size_t> digits, strides;
  std::size_t entries = 0;
  for (const LabelingConstraint& constraint : problem.constraints) {
    std::size_t own = 1;
    for (const Index v : constraint.scope) own *= tables.allowed(v).size();
    entries += own;
  }
  entries_.reserve(entries);
  for (const LabelingConstraint& constraint : problem.constraints) {
    if (deadline.reached()) return false;
    const std::size_t arity = constraint.scope.size();
    Table table{places_.size(), arity, entries_.size()};
    for (const Index v : constraint.scope) places_.push_back({offsets[v], offsets[v + 1] - offsets[v]});
    most_places = std::max(most_places, arity);
    strides.assign(arity, 1);
    for (std::size_t k = arity - 1; k-- > 0;) strides[k] = strides[k + 1] * tables.domain(constraint.scope[k + 1]);
    // The last place runs in the inner loop.
    digits.assign(arity, 0);
    const auto last = tables.allowed(constraint.scope[arity - 1]);
    for (bool more = true; more;) {
      std::size_t base = 0;
      for (std::size_t k = 0; k + 1 < arity; ++k) {
        const Index v = constraint.scope[k];
        base += strides[k] * (tables.allowed(v)[digits[k]] - tables.offset(v));
      }
      base -= tables.offset(constraint.scope[arity - 1]);
      for (const std::uint32_t position : last)
        entries_.push_back(static_cast<float>(std::clamp(-constraint.costs[base + position] / saturation, -1.0, 1.0)));
      more = false;
      for (std::size_t k = arity - 1; k-- > 0 && !more;) {
        more = ++digits[k] < tables.allowed(constraint.scope[k]).size();
        if (!more) digits[k] = 0;
      }
    }
    if (arity > 1) {
      tables_.push_back(table);
      continue;
    }
    for (std::size_t l = 0; l < places_.back().count; ++l) own_[places_.back().first + l] += entries_[table.entry + l];
    entries_.resize(table.entry);
    places_.pop_back();
  }
  digits_.resize(most_places);
  products_.resize(most_places + 1);
  return true;
}

bool Compatibilities::State::read_exclusions(const CostTables& tables, Deadline& deadline) {
  const LabelingProblem& problem = tables.problem();
  used_.resize(problem.candidate_count);
  excluding_.resize(problem.candidate_count);
  conflict_offsets_.assign(1, 0);
  for (Index c = 0; c < problem.candidate_count; ++c) {
    const auto conflicts = tables.state().conflicts_of(c);
    conflicts_.insert(conflicts_.end(), conflicts.begin(), conflicts.end());
    conflict_offsets_.push_back(conflicts_.size());
  }
  // How many other variables a label can be excluded by at most.
  std::vector<std::vector<Index>> users(problem.candidate_count);
  for (Index v = 0; v < variables(); ++v)
    for (std::size_t l = offsets[v]; l < offsets[v + 1]; ++l)
      if (candidates_[l] != no_candidate && (users[candidates_[l]].empty() || users[candidates_[l]].back() != v))
        users[candidates_[l]].push_back(v);
  std::vector<std::size_t> met(variables(), 0);
  std::size_t stamp = 0, most = 0;
  own_conflict_offsets_.assign(1, 0);
  for (Index v = 0; v < variables(); ++v)
    for (std::size_t l = offsets[v]; l < offsets[v + 1]; ++l) {
      if (deadline.reached()) return false;
      std::size_t excluding = 0;
      met[v] = ++stamp;
      if (candidates_[l] != no_candidate) {
        for (const Index other : tables.state().conflicts_of(candidates_[l]))
          for (const Index user : users[other])
            if (met[user] != stamp) {
              met[user] = stamp;
              ++excluding;
            }
        for (std::size_t m = offsets[v]; m < offsets[v + 1]; ++m)
          if (candidates_[m] != no_candidate && problem.conflict(candidates_[l], candidates_[m]))
            own_conflicts_.push_back(static_cast<std::uint32_t>(m));
      }
      most = std::max(most, excluding);
      own_conflict_offsets_.push_back(own_conflicts_.size());
    }
  degree += most;
  if (most == 0) candidates_.clear();
  return true;
}

std::optional<double> Compatibilities::State::support(std::span<const double> weights, std::span<double> support,
                                                      Deadline& deadline) {
  double consistency = 0;
  for (std::size_t l = 0; l < own_.size(); ++l) {
    support[l] = own_[l];
    consistency += weights[l] * support[l];
  }
  for (const Table& table : tables_) {
    if (deadline.reached()) return std::nullopt;
    consistency += table.places == 2 ? pair(table, weights, support) : wide(table, weights, support);
  }
  if (!candidates_.empty()) consistency += exclusions(weights, support);
  return consistency;
}

double Compatibilities::State::pair(const Table& table, std::span<const double> weights,
                                    std::span<double> support) const {
  const Place rows = places_[table.first_place], columns = places_[table.first_place + 1];
  const float* entries = entries_.data() + table.entry;
  const double* column_weights = weights.data() + columns.first;
  double* column_support = support.data() + columns.first;
  double consistency = 0;
  for (std::size_t a = 0; a < rows.count; ++a, entries += columns.count) {
    // Four sums side by side: the order of additions is fixed, and need not wait for each other.
    double sums[4] = {0, 0, 0, 0};
    std::size_t b = 0;
    for (; b + 4 <= columns.count; b += 4)
      for (std::size_t k = 0; k < 4; ++k) sums[k] += entries[b + k] * column_weights[b + k];
    for (; b < columns.count; ++b) sums[0] += entries[b] * column_weights[b];
    const double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    support[rows.first + a] += sum;
    const double weight = weights[rows.first + a];
    if (weight == 0) continue;
    consistency += weight * sum;
    for (b = 0; b < columns.count; ++b) column_support[b] += weight * entries[b];
  }
  return consistency;
}

// Each entry gives each place its compatibility times the weights of the others: products from the left are kept while
// the digits left of the change stay, those from the right are made on the way back.
double Compatibilities::State::wide(const Table& table, std::span<const double> weights, std::span<double> support) {
  const Place* places = places_.data() + table.first_place;
  const std::size_t arity = table.places;
  std::fill_n(digits_.begin(), arity, std::size_t{0});
  products_[0] = 1;
  double consistency = 0;
  std::size_t changed = 0;
  for (const float* entry = entries_.data() + table.entry;; ++entry) {
    for (std::size_t k = changed; k < arity; ++k)
      products_[k + 1] = products_[k] * weights[places[k].first + digits_[k]];
    consistency += *entry * products_[arity];
    double right = *entry;
    for (std::size_t k = arity; k-- > 0;) {
      const std::size_t label = places[k].first + digits_[k];
      support[label] += products_[k] * right;
      right *= weights[label];
    }
    changed = arity;
    while (changed > 0 && ++digits_[changed - 1] == places[changed - 1].count) digits_[--changed] = 0;
    if (changed == 0) return consistency;
    --changed;
  }
}

double Compatibilities::State::exclusions(std::span<const double> weights, std::span<double> support) {
  std::fill(used_.begin(), used_.end(), 0.0);
  for (std::size_t l = 0; l < candidates_.size(); ++l)
    if (candidates_[l] != no_candidate) used_[candidates_[l]] += weights[l];
  for (std::size_t c = 0; c < used_.size(); ++c) {
    excluding_[c] = 0;
    for (std::size_t k = conflict_offsets_[c]; k < conflict_offsets_[c + 1]; ++k) excluding_[c] += used_[conflicts_[k]];
  }
  double twice = 0;
  for (std::size_t l = 0; l < candidates_.size(); ++l) {
    if (candidates_[l] == no_candidate) continue;
    double others = excluding_[candidates_[l]];
    for (std::size_t k = own_conflict_offsets_[l]; k < own_conflict_offsets_[l + 1]; ++k)
      others -= weights[own_conflicts_[k]];
    support[l] -= others;
    twice += weights[l] * others;
  }
  return -twice / 2;
}

}  // namespace toposcope
