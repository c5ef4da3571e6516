// SPDX-License-Identifier: BSD-3-Clause
#include "soft_network.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace toposcope::least_error {
namespace {

constexpr double largest_sum = 1 << 26;  // of all units: moved costs stay far below `infinite`

Cost saturated(Cost a, Cost b) {
  return is_forbidden(a) || is_forbidden(b) ? infinite : std::min(infinite, a + b);
}

/// Finds the unit: the costs' own where they are decimals or dyadic, else as fine as fits.
class Unit {
 public:
  void add(double cost) {
    for (std::size_t base = 0; base < 2; ++base) {
      double& scale = scale_[base];
      while (scale <= 1e9 && std::abs(cost * scale - std::round(cost * scale)) > 1e-7) scale *= base == 0 ? 10 : 2;
    }
  }
  /// \param range  of a sum of all costs \param exact  every cost is a whole number of units
  double scale(double range, bool& exact) const {
    for (const double scale : scale_)
      if ((exact = range * scale <= largest_sum)) return scale;
    return std::exp2(std::floor(std::log2(largest_sum / range)));
  }

 private:
  std::array<double, 2> scale_ = {1, 1};
};

/// A constraint over the values that are left, row-major.
struct Term {
  std::vector<int> variables;
  std::vector<double> costs;
  double least = 0;
};

}  // namespace

__attribute__((noinline)) TOPOSCOPE_WIDE Cost least_sum(const Cost* row, const Cost* weight, int size) {
  Cost least = 2 * infinite - 1;
  for (int b = 0; b < size; ++b) {
    const Cost sum = row[b] + weight[b];
    least = sum < least ? sum : least;
  }
  return least;
}

__attribute__((noinline)) TOPOSCOPE_WIDE void raise(Cost* need, const Cost* row, Cost level, int size) {
  for (int b = 0; b < size; ++b) {
    const Cost lack = level - row[b];
    need[b] = lack > need[b] ? lack : need[b];
  }
}

SoftNetwork::SoftNetwork(const LabelingProblem& problem, Deadline& deadline) : problem_(problem) {
  const int n = static_cast<int>(problem.variables.size());
  std::vector<double> unary;
  for (const LabelingVariable& variable : problem.variables) {
    first_.push_back(static_cast<int>(values_.size()));
    for (Index value = 0; value < variable.domain(); ++value) {
      if (!(variable.costs[value] < forbidden)) continue;
      values_.push_back(value);
      candidates_.push_back(variable.candidate(value));
      unary.push_back(variable.costs[value]);
    }
    size_.push_back(static_cast<int>(values_.size()) - first_.back());
    infeasible_ = infeasible_ || size_.back() == 0;
  }
  if (infeasible_) return;

  // What is left of each term, its least cost taken out; the range of all and the unit that serves them.
  offset_ = problem.constant;
  double range = 1;
  Unit unit;
  std::size_t terms = 0;
  const auto normalise = [&](double* costs, std::size_t count) {
    double least = forbidden, most = -forbidden;
    for (std::size_t k = 0; k < count; ++k)
      if (costs[k] < forbidden) {
        least = std::min(least, costs[k]);
        most = std::max(most, costs[k]);
      }
    if (least == forbidden) {
      infeasible_ = true;
      return;
    }
    for (std::size_t k = 0; k < count; ++k)
      if ((costs[k] -= least) < forbidden) unit.add(costs[k]);
    offset_ += least;
    range += most - least;
    terms += most > least;
  };
  for (int v = 0; v < n; ++v) normalise(unary.data() + first_[v], static_cast<std::size_t>(size_[v]));
  std::vector<Term> kept;
  for (const LabelingConstraint& constraint : problem.constraints) {
    Term term;
    std::size_t entries = 1;
    for (const Index v : constraint.scope) {
      term.variables.push_back(static_cast<int>(v));
      entries *= static_cast<std::size_t>(size_[v]);
    }
    term.costs.reserve(entries);
    std::vector<int> digit(term.variables.size(), 0);
    for (bool more = true; more;) {
      if ((term.costs.size() & 4095U) == 0 && deadline.reached()) {
        complete_ = false;
        return;
      }
      std::size_t entry = 0;
      for (std::size_t k = 0; k < digit.size(); ++k)
        entry = entry * problem.variables[constraint.scope[k]].domain() +
                values_[static_cast<std::size_t>(first_[term.variables[k]] + digit[k])];
      term.costs.push_back(constraint.costs[entry]);
      more = false;
      for (std::size_t k = digit.size(); k-- > 0 && !more;) {
        more = ++digit[k] < size_[term.variables[k]];
        if (!more) digit[k] = 0;
      }
    }
    normalise(term.costs.data(), term.costs.size());
    if (infeasible_) return;
    kept.push_back(std::move(term));
  }
  bool exact = true;
  scale_ = unit.scale(range, exact);
  error_ = exact ? 1e-3 : 0.5 * static_cast<double>(terms) + 1;
  const auto units = [&](double cost) {
    return cost < forbidden ? static_cast<Cost>(std::llround(cost * scale_)) : infinite;
  };

  for (int v = 0; v < n; ++v) {
    unary_.push_back(costs_.size());
    for (int a = 0; a < size_[v]; ++a) {
      costs_.push_back(units(unary[static_cast<std::size_t>(first_[v] + a)]));
      order_.push_back(a);
      place_.push_back(a);
    }
  }
  count_ = size_;
  uses_.resize(size_.size());
  delayed_uses_.resize(size_.size());
  for (Term& term : kept) {
    if (term.variables.size() == 1) {
      Cost* own = this->unary(term.variables[0]);
      for (std::size_t a = 0; a < term.costs.size(); ++a) own[a] = saturated(own[a], units(term.costs[a]));
    } else if (term.variables.size() == 2) {
      const int x = term.variables[0], y = term.variables[1];
      BinaryFunction& f = functions_[static_cast<std::size_t>(function_between(x, y))];
      const bool turned = f.variable[0] != x;
      const std::size_t rows = static_cast<std::size_t>(size_[x]), columns = static_cast<std::size_t>(size_[y]);
      for (std::size_t a = 0; a < rows; ++a)
        for (std::size_t b = 0; b < columns; ++b) {
          Cost& cost = turned ? f.table[0][b * rows + a] : f.table[0][a * columns + b];
          cost = saturated(cost, units(term.costs[a * columns + b]));
        }
    } else {
      DelayedFunction delayed;
      delayed.variables = term.variables;
      delayed.strides.assign(term.variables.size(), 1);
      for (std::size_t k = term.variables.size() - 1; k-- > 0;)
        delayed.strides[k] = delayed.strides[k + 1] * static_cast<std::size_t>(size_[term.variables[k + 1]]);
      delayed.table.reserve(term.costs.size());
      for (const double cost : term.costs) delayed.table.push_back(units(cost));
      for (const int v : term.variables)
        delayed_uses_[static_cast<std::size_t>(v)].push_back(static_cast<int>(delayed_.size()));
      delayed_.push_back(std::move(delayed));
    }
    term.costs = {};
    if (deadline.reached()) {
      complete_ = false;
      return;
    }
  }
  project_delayed();
  for (BinaryFunction& f : functions_) {
    const int x = f.variable[0], y = f.variable[1];
    const std::size_t rows = static_cast<std::size_t>(size_[x]), columns = static_cast<std::size_t>(size_[y]);
    f.table[1].resize(f.table[0].size());
    for (std::size_t a = 0; a < rows; ++a)
      for (std::size_t b = 0; b < columns; ++b) {
        Cost& cost = f.table[0][a * columns + b];
        if (excludes(x, static_cast<int>(a), y, static_cast<int>(b))) cost = infinite;
        f.table[1][b * rows + a] = cost;
      }
  }
  released_.assign(delayed_.size(), 0);
  for (std::size_t f = 0; f < functions_.size(); ++f)
    for (int side = 0; side < 2; ++side) {
      functions_[f].moved[side] = costs_.size();
      const int v = functions_[f].variable[side];
      costs_.resize(costs_.size() + static_cast<std::size_t>(size_[v]), 0);
      uses_[static_cast<std::size_t>(v)].push_back({static_cast<int>(f), side});
    }
  stamp_.assign(size_.size() + 2 * functions_.size(), 0);
}

int SoftNetwork::function_between(int x, int y) {
  const auto [at, made] = between_.try_emplace(std::minmax(x, y), static_cast<int>(functions_.size()));
  if (made) {
    BinaryFunction& f = functions_.emplace_back();
    f.variable[0] = std::min(x, y);
    f.variable[1] = std::max(x, y);
    f.table[0].assign(static_cast<std::size_t>(size_[x]) * static_cast<std::size_t>(size_[y]), 0);
  }
  return at->second;
}

// What a function of many variables asks of a pair whatever the others are goes to the pair at once.
void SoftNetwork::project_delayed() {
  for (DelayedFunction& delayed : delayed_) {
    const std::size_t arity = delayed.variables.size();
    for (std::size_t i = 0; i < arity; ++i)
      for (std::size_t j = i + 1; j < arity; ++j) {
        const int x = delayed.variables[i], y = delayed.variables[j];
        BinaryFunction& f = functions_[static_cast<std::size_t>(function_between(x, y))];
        const std::size_t rows = static_cast<std::size_t>(size_[x]), columns = static_cast<std::size_t>(size_[y]);
        std::vector<Cost> least(rows * columns, infinite);
        const auto at = [&](std::size_t entry) {
          return entry / delayed.strides[i] % rows * columns + entry / delayed.strides[j] % columns;
        };
        for (std::size_t entry = 0; entry < delayed.table.size(); ++entry)
          least[at(entry)] = std::min(least[at(entry)], delayed.table[entry]);
        for (std::size_t entry = 0; entry < delayed.table.size(); ++entry) {
          Cost& cost = delayed.table[entry];
          const Cost taken = least[at(entry)];
          if (is_forbidden(taken))
            cost = 0;  // the pair forbids it
          else if (!is_forbidden(cost))
            cost -= taken;
        }
        for (std::size_t a = 0; a < rows; ++a)
          for (std::size_t b = 0; b < columns; ++b) {
            Cost& cost = f.variable[0] == x ? f.table[0][a * columns + b] : f.table[0][b * rows + a];
            cost = saturated(cost, least[a * columns + b]);
          }
      }
  }
}

void SoftNetwork::remove(int variable, int value) {
  const int first = first_[variable], last = --count_[variable];
  const int at = place_[first + value], moved = order_[first + last];
  std::swap(order_[first + at], order_[first + last]);
  place_[first + moved] = at;
  place_[first + value] = last;
  if (!marks_.empty()) removed_.push_back(variable);
}

// Joins a waiting function to the binary one of the (at most) two variables that are still open; -1: it waits on.
int SoftNetwork::release(int d) {
  if (released_[static_cast<std::size_t>(d)]) return -1;
  const DelayedFunction& delayed = delayed_[static_cast<std::size_t>(d)];
  std::size_t pair[2] = {0, 0}, open = 0;
  for (std::size_t k = 0; k < delayed.variables.size(); ++k)
    if (count_[delayed.variables[k]] > 1) {
      if (open == 2) return -1;
      pair[open++] = k;
    }
  for (std::size_t k = 0; open < 2; ++k)  // fill up with assigned ones
    if (open == 0 || k != pair[0]) pair[open++] = k;
  if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
  std::size_t base = 0;
  for (std::size_t k = 0; k < delayed.variables.size(); ++k)
    if (k != pair[0] && k != pair[1])
      base += delayed.strides[k] * static_cast<std::size_t>(values(delayed.variables[k])[0]);
  const int x = delayed.variables[pair[0]], y = delayed.variables[pair[1]];
  const int index = between_.at(std::minmax(x, y));
  BinaryFunction& f = functions_[static_cast<std::size_t>(index)];
  releases_.push_back({d, index, released_costs_.size()});
  if (!marks_.empty()) released_costs_.insert(released_costs_.end(), f.table[0].begin(), f.table[0].end());
  released_[static_cast<std::size_t>(d)] = 1;
  const std::size_t side = f.variable[0] == x ? 0 : 1;
  const std::size_t rows = static_cast<std::size_t>(size_[x]), columns = static_cast<std::size_t>(size_[y]);
  for (std::size_t a = 0; a < rows; ++a)
    for (std::size_t b = 0; b < columns; ++b) {
      Cost& cost = f.table[side][a * columns + b];
      cost = saturated(cost, delayed.table[base + a * delayed.strides[pair[0]] + b * delayed.strides[pair[1]]]);
      f.table[1 - side][b * rows + a] = cost;
    }
  return index;
}

void SoftNetwork::mark() {
  marks_.push_back({saved_.size(), saved_costs_.size(), removed_.size(), releases_.size(), constant_, now_});
  now_ = ++stamps_;
}

void SoftNetwork::undo() {
  const Mark mark = marks_.back();
  marks_.pop_back();
  while (saved_.size() > mark.saved) {
    const Saved& saved = saved_.back();
    std::copy_n(saved_costs_.begin() + static_cast<std::ptrdiff_t>(saved.data), saved.length,
                costs_.begin() + static_cast<std::ptrdiff_t>(saved.offset));
    *saved.stamp = saved.old_stamp;
    saved_.pop_back();
  }
  saved_costs_.resize(mark.data);
  for (; removed_.size() > mark.removed; removed_.pop_back()) ++count_[removed_.back()];
  for (; releases_.size() > mark.released; releases_.pop_back()) {
    const Release& release = releases_.back();
    released_[static_cast<std::size_t>(release.delayed)] = 0;
    BinaryFunction& f = functions_[static_cast<std::size_t>(release.function)];
    const std::size_t rows = static_cast<std::size_t>(size_[f.variable[0]]);
    const std::size_t columns = static_cast<std::size_t>(size_[f.variable[1]]);
    std::copy_n(released_costs_.begin() + static_cast<std::ptrdiff_t>(release.data), rows * columns,
                f.table[0].begin());
    for (std::size_t a = 0; a < rows; ++a)
      for (std::size_t b = 0; b < columns; ++b) f.table[1][b * rows + a] = f.table[0][a * columns + b];
    released_costs_.resize(release.data);
  }
  constant_ = mark.constant;
  now_ = mark.stamp;
}

Cost SoftNetwork::cutoff(double limit, bool inclusive) const {
  double units = (limit - offset_) * scale_ + error_;
  units = inclusive ? std::floor(units) + 1 : std::ceil(units - 2e-3 * (error_ < 1));
  return static_cast<Cost>(std::clamp(units, -static_cast<double>(infinite / 4), largest_sum * 1.5));
}

}  // namespace toposcope::least_error
