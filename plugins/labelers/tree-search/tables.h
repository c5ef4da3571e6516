// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A labelling problem made ready for depth-first search: variables in the order in which they enter the tree, every
// relationship's table cut into increments that only ever add to a lower bound.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "toposcope/labeling.h"
#include "toposcope/labeling_tools.h"

namespace toposcope::tree_search {

/// What a relation that cannot apply counts where violations are summed and nothing is forbidden.
inline constexpr double inapplicable_violation = 1e9;

/// Violation of a table entry as the rank `violation` counts it. A relation left untested by a missing feature counts
/// 1, the worst that a satisfied one can be: otherwise the labelling that finds nothing would satisfy best.
inline double counted_violation(bool untested, double violation) {
  return untested ? 1.0 : std::min(violation, inapplicable_violation);
}

/// Variables in the order in which they enter the tree (dissertation 3.4.2): relationships by the product of their
/// features' detectabilities, within each the most detectable feature first; those in no relationship last. Ties keep
/// the order of the problem.
inline std::vector<Index> search_order(const LabelingProblem& problem) {
  const auto by_detectability = [&](std::vector<Index> features) {
    std::stable_sort(features.begin(), features.end(), [&](Index a, Index b) {
      return problem.variables[a].detectability > problem.variables[b].detectability;
    });
    return features;
  };
  std::vector<double> detectability;
  for (const LabelingConstraint& constraint : problem.constraints) {
    double product = 1;
    for (const Index feature : constraint.scope) product *= problem.variables[feature].detectability;
    detectability.push_back(product);
  }
  std::vector<Index> ranked(problem.constraints.size());
  std::iota(ranked.begin(), ranked.end(), Index{0});
  std::stable_sort(ranked.begin(), ranked.end(), [&](Index a, Index b) { return detectability[a] > detectability[b]; });
  std::vector<Index> order;
  const auto enter = [&](const std::vector<Index>& features) {
    for (const Index feature : by_detectability(features))
      if (std::find(order.begin(), order.end(), feature) == order.end()) order.push_back(feature);
  };
  for (const Index relationship : ranked) enter(problem.constraints[relationship].scope);
  std::vector<Index> all(problem.variables.size());
  std::iota(all.begin(), all.end(), Index{0});
  enter(all);
  return order;
}

/// What a relationship adds to the values of one variable once the variables of its scope before it are assigned: the
/// least that the relationship can still cost, less what was counted already. Summed along a path the increments give
/// the relationship's cost, and at any node an exact lower bound of it.
struct Increment {
  Index depth = 0;                   ///< of the variable to which it is added
  std::vector<Index> earlier;        ///< depths of the assigned variables of the scope
  std::vector<std::size_t> strides;  ///< of these, in `table`
  std::vector<double> table;         ///< rows over the values of the variable at `depth`

  const double* row(const std::vector<Index>& values) const {
    std::size_t at = 0;
    for (std::size_t k = 0; k < earlier.size(); ++k) at += strides[k] * values[earlier[k]];
    return table.data() + at;
  }
};

/// One additive objective over labellings: the costs, or the violations.
struct Objective {
  std::vector<double> root;                   ///< per variable in search order, per value: unary and first increments
  std::vector<std::vector<Increment>> after;  ///< by depth of the variable whose assignment makes them due
  double slack = 0;                           ///< more than the rounding of any sum of it
};

class Tables {
 public:
  Tables(const LabelingProblem& given, bool crisp, bool by_violation) : problem(given), order(search_order(given)) {
    offsets.push_back(0);
    depth_of.resize(order.size());
    for (Index depth = 0; depth < order.size(); ++depth) {
      depth_of[order[depth]] = depth;
      offsets.push_back(offsets.back() + problem.variables[order[depth]].domain());
    }
    cost = objective(crisp, false);
    if (by_violation) violation = objective(crisp, true);
  }

  Index depths() const { return static_cast<Index>(order.size()); }
  Index domain(Index depth) const { return static_cast<Index>(offsets[depth + 1] - offsets[depth]); }
  const LabelingVariable& variable(Index depth) const { return problem.variables[order[depth]]; }

  /// Sum of the violations, and the cost, of a labelling in the problem's order.
  std::pair<double, double> evaluate(const std::vector<Index>& values) const {
    double total_violation = 0, total_cost = 0;
    for (std::size_t i = 0; i < values.size(); ++i) total_cost += problem.variables[i].costs[values[i]];
    for (const LabelingConstraint& constraint : problem.constraints) {
      std::size_t at = 0;
      bool untested = false;
      for (const Index v : constraint.scope) {
        at = at * problem.variables[v].domain() + values[v];
        untested = untested || values[v] == 0;
      }
      total_violation += counted_violation(untested, constraint.violations[at]);
      total_cost += constraint.costs[at];
    }
    return {total_violation, total_cost};
  }

  /// No labelling costs less.
  double root_bound() const {
    double sum = 0;
    for (std::size_t depth = 0; depth < order.size(); ++depth) {
      const auto first = cost.root.begin();
      sum += *std::min_element(first + static_cast<std::ptrdiff_t>(offsets[depth]),
                               first + static_cast<std::ptrdiff_t>(offsets[depth + 1]));
    }
    return sum - cost.slack;
  }

  const LabelingProblem& problem;
  std::vector<Index> order, depth_of;
  std::vector<std::size_t> offsets;  ///< of each variable's values in Objective::root
  Objective cost, violation;

 private:
  Objective objective(bool crisp, bool violations) const {
    Objective made;
    made.root.assign(offsets.back(), 0);
    made.after.resize(order.size());
    double magnitude = 1;
    const auto grow = [&](double largest, double value) {
      return std::isfinite(value) ? std::max(largest, std::abs(value)) : largest;
    };
    if (!violations)
      for (Index depth = 0; depth < order.size(); ++depth) {
        const std::vector<double>& costs = variable(depth).costs;
        std::copy(costs.begin(), costs.end(), made.root.begin() + static_cast<std::ptrdiff_t>(offsets[depth]));
        magnitude += std::accumulate(costs.begin(), costs.end(), 0.0, grow);
      }
    struct Ordered {
      std::vector<Index> scope;
      std::vector<double> table;
    };
    std::vector<std::vector<Ordered>> ending(order.size());  // by the last variable of the scope
    for (const LabelingConstraint& constraint : problem.constraints) {
      Ordered ordered;
      ordered.table = ordered_table(constraint, crisp, violations, ordered.scope);
      magnitude += std::accumulate(ordered.table.begin(), ordered.table.end(), 0.0, grow);
      if (ordered.scope.size() == 1)
        for (std::size_t v = 0; v < ordered.table.size(); ++v)
          made.root[offsets[ordered.scope[0]] + v] += ordered.table[v];
      else
        ending[ordered.scope.back()].push_back(std::move(ordered));
    }
    // From the last variable to the first: what its values cost is shared out among the relationships that end at it,
    // so that their minima know of it. That moves costs about without changing any labelling's.
    for (Index depth = depths(); depth-- > 0;) {
      if (ending[depth].empty()) continue;
      const std::size_t width = domain(depth);
      const double share = 1 / static_cast<double>(ending[depth].size());
      double* own = made.root.data() + offsets[depth];
      for (Ordered& ordered : ending[depth]) {
        for (std::size_t entry = 0; entry < ordered.table.size(); ++entry)
          ordered.table[entry] += share * own[entry % width];
        add_increments(ordered.scope, std::move(ordered.table), made);
      }
      for (std::size_t v = 0; v < width; ++v)
        if (own[v] < forbidden) own[v] = 0;
    }
    made.slack = 1e-12 * magnitude;
    return made;
  }

  // The constraint's table with its scope in search order (`scope` receives the depths), what is forbidden infinite.
  std::vector<double> ordered_table(const LabelingConstraint& constraint, bool crisp, bool violations,
                                    std::vector<Index>& scope) const {
    const std::size_t arity = constraint.scope.size();
    for (const Index v : constraint.scope) scope.push_back(depth_of[v]);
    std::sort(scope.begin(), scope.end());
    std::vector<std::size_t> stride(arity), digits(arity, 0);  // of the problem's k-th scope variable in our table
    for (std::size_t k = 0; k < arity; ++k) {
      stride[k] = 1;
      for (const Index depth : scope)
        if (depth > depth_of[constraint.scope[k]]) stride[k] *= domain(depth);
    }
    std::vector<double> table(constraint.costs.size());
    for (std::size_t entry = 0; entry < table.size(); ++entry) {
      std::size_t at = 0;
      for (std::size_t k = 0; k < arity; ++k) at += stride[k] * digits[k];
      const bool untested = std::find(digits.begin(), digits.end(), std::size_t{0}) != digits.end();
      const double residual = constraint.violations[entry];
      const bool cut = crisp && !untested && !(residual <= 1);
      const double value = violations ? counted_violation(untested, residual) : constraint.costs[entry];
      table[at] = cut ? forbidden : value;
      for (std::size_t k = arity; k-- > 0;) {  // next digits, the last variable fastest
        if (++digits[k] < problem.variables[constraint.scope[k]].domain()) break;
        digits[k] = 0;
      }
    }
    return table;
  }

  // Minima over the last variable, the last two, ... and the differences between one such table and the next.
  void add_increments(const std::vector<Index>& scope, std::vector<double> table, Objective& made) const {
    for (std::size_t k = scope.size(); k-- > 0;) {
      const std::size_t width = domain(scope[k]);
      if (k == 0) {
        for (std::size_t v = 0; v < width; ++v) made.root[offsets[scope[0]] + v] += table[v];
        return;
      }
      std::vector<double> least(table.size() / width);
      for (std::size_t row = 0; row < least.size(); ++row) {
        const auto first = table.begin() + static_cast<std::ptrdiff_t>(row * width);
        least[row] = *std::min_element(first, first + static_cast<std::ptrdiff_t>(width));
        if (least[row] < forbidden)  // else the value before is forbidden and the row never asked for
          for (std::size_t v = 0; v < width; ++v) table[row * width + v] -= least[row];
      }
      Increment increment;
      increment.depth = scope[k];
      increment.earlier.assign(scope.begin(), scope.begin() + static_cast<std::ptrdiff_t>(k));
      increment.strides.assign(k, width);
      for (std::size_t i = k - 1; i-- > 0;) increment.strides[i] = increment.strides[i + 1] * domain(scope[i + 1]);
      increment.table = std::move(table);
      made.after[scope[k - 1]].push_back(std::move(increment));
      table = std::move(least);
    }
  }
};

}  // namespace toposcope::tree_search
