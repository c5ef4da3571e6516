// SPDX-License-Identifier: BSD-3-Clause
// How a network is made of a problem: the costs over the values that are left, in whole units.

#include <algorithm>
#include <array>
#include <cmath>

#include "soft_network.h"

namespace toposcope::least_error {
namespace {

/// Finds the unit: the costs' own where they are decimals or dyadic, else as fine as fits.
class Unit {
 public:
  void add(double cost) {
    for (std::size_t base = 0; base < 2; ++base) {
      double& scale = scale_[base];
      while (scale <= 1e9 && std::abs(cost * scale - std::round(cost * scale)) > 1e-7) scale *= base == 0 ? 10 : 2;
    }
  }
  /// \param range  of a sum of all costs \param step  every cost is a multiple of so many units; 0: they are rounded
  double scale(double range, double& step) const {
    for (const double scale : scale_) {
      if (range * scale > SoftNetwork::largest_sum) continue;
      // Finer than the costs, so that they can be moved in small parts.
      step = std::exp2(std::floor(std::log2(SoftNetwork::largest_sum / (range * scale))));
      return scale * step;
    }
    step = 0;
    return std::exp2(std::floor(std::log2(SoftNetwork::largest_sum / range)));
  }

 private:
  std::array<double, 2> scale_ = {1, 1};
};

/// A constraint over the values that are left, row-major.
struct Term {
  std::vector<int> variables;
  std::vector<double> costs;
};

}  // namespace

/// The problem in its own numbers, the least cost of each term taken out.
struct SoftNetwork::Terms {
  std::vector<double> unary;  ///< of all variables' values, one variable after the other
  std::vector<Term> constraints;
  Unit unit;
  double offset = 0, range = 1;  ///< range: of a sum of all costs
  std::size_t graded = 0;        ///< terms that have several finite costs

  /// \return false where no cost is finite
  bool add(std::span<double> costs) {
    double least = forbidden, most = -forbidden;
    for (const double cost : costs)
      if (cost < forbidden) {
        least = std::min(least, cost);
        most = std::max(most, cost);
      }
    if (least == forbidden) return false;
    for (double& cost : costs)
      if ((cost -= least) < forbidden) unit.add(cost);
    offset += least;
    range += most - least;
    graded += most > least;
    return true;
  }
};

SoftNetwork::SoftNetwork(const LabelingProblem& problem, Deadline& deadline) : problem_(problem) {
  Terms terms;
  terms.offset = problem.constant;
  infeasible_ = !read_variables(terms);
  if (infeasible_ || !read_constraints(terms, deadline)) return;
  offset_ = terms.offset;
  scale_ = terms.unit.scale(terms.range, step_);
  error_ = 0.5 * static_cast<double>(terms.graded) + 1;
  if (!make_functions(terms, deadline)) return;
  project_delayed();
  add_cliques();
  complete_functions();
}

Cost SoftNetwork::units(double cost) const {
  if (!(cost < forbidden)) return infinite;
  return static_cast<Cost>(step_ > 0 ? std::llround(cost * scale_ / step_) * std::llround(step_)
                                     : std::llround(cost * scale_));
}

// False where a variable has no value left.
bool SoftNetwork::read_variables(Terms& terms) {
  for (const LabelingVariable& variable : problem_.variables) {
    first_.push_back(static_cast<int>(values_.size()));
    for (Index value = 0; value < variable.domain(); ++value) {
      if (!(variable.costs[value] < forbidden)) continue;
      values_.push_back(value);
      candidates_.push_back(variable.candidate(value));
      terms.unary.push_back(variable.costs[value]);
    }
    size_.push_back(static_cast<int>(values_.size()) - first_.back());
  }
  if (std::find(size_.begin(), size_.end(), 0) != size_.end()) return false;
  for (std::size_t v = 0; v < size_.size(); ++v)
    terms.add({terms.unary.data() + first_[v], static_cast<std::size_t>(size_[v])});
  return true;
}

// False where that ended early: a constraint forbids all, or the deadline came.
bool SoftNetwork::read_constraints(Terms& terms, Deadline& deadline) {
  for (const LabelingConstraint& constraint : problem_.constraints) {
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
        return false;
      }
      std::size_t entry = 0;
      for (std::size_t k = 0; k < digit.size(); ++k)
        entry = entry * problem_.variables[constraint.scope[k]].domain() +
                values_[static_cast<std::size_t>(first_[term.variables[k]] + digit[k])];
      term.costs.push_back(constraint.costs[entry]);
      more = false;
      for (std::size_t k = digit.size(); k-- > 0 && !more;) {
        more = ++digit[k] < size_[term.variables[k]];
        if (!more) digit[k] = 0;
      }
    }
    infeasible_ = !terms.add(term.costs);
    if (infeasible_) return false;
    terms.constraints.push_back(std::move(term));
  }
  return true;
}

// False where the deadline came.
bool SoftNetwork::make_functions(Terms& terms, Deadline& deadline) {
  for (std::size_t v = 0; v < size_.size(); ++v) {
    unary_.push_back(costs_.size());
    for (int a = 0; a < size_[v]; ++a) {
      costs_.push_back(units(terms.unary[static_cast<std::size_t>(first_[v] + a)]));
      order_.push_back(a);
      place_.push_back(a);
    }
  }
  count_ = size_;
  uses_.resize(size_.size());
  delayed_uses_.resize(size_.size());
  for (Term& term : terms.constraints) {
    if (term.variables.size() == 1) {
      Cost* own = unary(term.variables[0]);
      for (std::size_t a = 0; a < term.costs.size(); ++a) own[a] = saturated(own[a], units(term.costs[a]));
    } else if (term.variables.size() == 2) {
      add_binary(term.variables[0], term.variables[1], term.costs);
    } else {
      add_delayed(term.variables, term.costs);
    }
    term.costs = {};
    if (deadline.reached()) {
      complete_ = false;
      return false;
    }
  }
  return true;
}

void SoftNetwork::add_binary(int x, int y, std::span<const double> costs) {
  BinaryFunction& f = functions_[static_cast<std::size_t>(function_between(x, y))];
  const bool turned = f.variable[0] != x;
  const std::size_t rows = static_cast<std::size_t>(size_[x]), columns = static_cast<std::size_t>(size_[y]);
  for (std::size_t a = 0; a < rows; ++a)
    for (std::size_t b = 0; b < columns; ++b) {
      Cost& cost = turned ? f.table[0][b * rows + a] : f.table[0][a * columns + b];
      cost = saturated(cost, units(costs[a * columns + b]));
    }
}

void SoftNetwork::add_delayed(const std::vector<int>& variables, std::span<const double> costs) {
  DelayedFunction delayed;
  delayed.variables = variables;
  delayed.strides.assign(variables.size(), 1);
  for (std::size_t k = variables.size() - 1; k-- > 0;)
    delayed.strides[k] = delayed.strides[k + 1] * static_cast<std::size_t>(size_[variables[k + 1]]);
  delayed.table.reserve(costs.size());
  for (const double cost : costs) delayed.table.push_back(units(cost));
  for (const int v : variables) delayed_uses_[static_cast<std::size_t>(v)].push_back(static_cast<int>(delayed_.size()));
  delayed_.push_back(std::move(delayed));
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

// Exclusions, the transposed tables, and the places of what is moved.
void SoftNetwork::complete_functions() {
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
    crisp_ +=
        std::all_of(f.table[0].begin(), f.table[0].end(), [](Cost cost) { return cost == 0 || is_forbidden(cost); });
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

}  // namespace toposcope::least_error
