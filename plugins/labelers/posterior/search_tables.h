// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A factor graph made ready for depth-first search: variables in the order in which they enter the tree, every factor
// cut into increments that only ever add to a lower bound of the cost.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "factors.h"
#include "toposcope/geometry/large_array.h"
#include "watch.h"

namespace toposcope::posterior {

/// Four chains of minima at a time: the processor need not wait for one.
inline double least_of(const double* costs, std::size_t count) {
  double least[4] = {forbidden, forbidden, forbidden, forbidden};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (std::size_t k = 0; k < 4; ++k) least[k] = std::min(least[k], costs[i + k]);
  for (; i < count; ++i) least[0] = std::min(least[0], costs[i]);
  return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

/// What a factor adds to the values of one variable once the variables of its scope before it are assigned: the least
/// that the factor can still cost, less what was counted already. Summed along a path the increments give the factor's
/// cost, and at any node an exact lower bound of it.
struct Increment {
  Index depth = 0;                   ///< of the variable to which it is added
  std::vector<Index> earlier;        ///< depths of the assigned variables of the scope
  std::vector<std::size_t> strides;  ///< of these, in `table`
  std::vector<double> table;         ///< rows over the values of the variable at `depth`

  const double* row(const std::vector<Index>& at) const {
    std::size_t offset = 0;
    for (std::size_t k = 0; k < earlier.size(); ++k) offset += strides[k] * at[earlier[k]];
    return table.data() + offset;
  }
};

class SearchTables {
 public:
  /// \param search_order  variables of the graph, the first to be assigned first \throw OutOfTime
  SearchTables(const FactorGraph& graph, std::vector<Index> search_order, Watch& watch)
      : order(std::move(search_order)), after(order.size()), graph_(graph), watch_(watch) {
    std::vector<Index> depth_of(order.size());
    offsets.push_back(0);
    for (Index depth = 0; depth < order.size(); ++depth) {
      depth_of[order[depth]] = depth;
      offsets.push_back(offsets.back() + graph.domain(order[depth]));
    }
    for (const Index v : order) root.insert(root.end(), graph.unary[v].begin(), graph.unary[v].end());
    std::vector<std::vector<Ordered>> ending(order.size());  // by the last variable of the scope
    for (const Factor& factor : graph.factors) {
      std::vector<Index> scope;
      for (const Index v : factor.scope) scope.push_back(depth_of[v]);
      std::sort(scope.begin(), scope.end());
      std::vector<Ordered>& here = ending[scope.back()];
      auto same = std::find_if(here.begin(), here.end(), [&](const Ordered& other) { return other.scope == scope; });
      if (same == here.end()) same = here.insert(here.end(), {scope, {}});
      for (Index& depth : scope) depth = order[depth];
      add_reordered(graph, factor, scope, same->table, watch);
      same->graded = same->graded || std::any_of(factor.costs.begin(), factor.costs.end(),
                                                 [](double cost) { return cost != 0 && cost < forbidden; });
    }
    std::vector<double> shared;
    // From the last variable to the first: what its values cost is shared out among the factors that end at it, so that
    // their minima know of it. That moves costs about without changing any labelling's.
    for (Index depth = depths(); depth-- > 0;) {
      const auto informed = std::count_if(ending[depth].begin(), ending[depth].end(),
                                          [](const Ordered& ordered) { return ordered.graded; });
      const std::size_t width = domain(depth);
      double* own = root.data() + offsets[depth];
      for (Ordered& ordered : ending[depth]) {
        if (ordered.graded) {
          shared.resize(width);
          for (std::size_t v = 0; v < width; ++v) shared[v] = own[v] / static_cast<double>(informed);
          for (std::size_t entry = 0; entry < ordered.table.size(); entry += width) {
            double* row = ordered.table.data() + entry;
            for (std::size_t v = 0; v < width; ++v) row[v] += shared[v];
            watch_.poll(width);
          }
        }
        add_increments(ordered.scope, std::move(ordered.table));
      }
      if (informed > 0)
        for (std::size_t v = 0; v < width; ++v)
          if (own[v] < forbidden) own[v] = 0;
    }
  }

  Index depths() const { return static_cast<Index>(order.size()); }
  std::size_t domain(Index depth) const { return offsets[depth + 1] - offsets[depth]; }

  /// No labelling costs less, but for rounding.
  double bound() const {
    double sum = graph_.constant;
    for (std::size_t depth = 0; depth < order.size(); ++depth)
      sum += *std::min_element(root.data() + offsets[depth], root.data() + offsets[depth + 1]);
    return sum;
  }

  std::vector<Index> order;
  std::vector<std::size_t> offsets;           ///< of each variable's values in `root`, by depth
  std::vector<double> root;                   ///< per variable in search order, per value: unary and first increments
  std::vector<std::vector<Increment>> after;  ///< by depth of the variable whose assignment makes them due

 private:
  struct Ordered {
    std::vector<Index> scope;  ///< depths, ascending
    std::vector<double> table;
    bool graded = false;  ///< false: it only forbids
  };

  // Minima over the last variable, the last two, ... and the differences between one such table and the next.
  void add_increments(const std::vector<Index>& scope, std::vector<double> table) {
    for (std::size_t k = scope.size(); k-- > 0;) {
      const std::size_t width = domain(scope[k]);
      if (k == 0) {
        for (std::size_t v = 0; v < width; ++v) root[offsets[scope[0]] + v] += table[v];
        return;
      }
      std::vector<double> least(table.size() / width);
      for (std::size_t row = 0; row < least.size(); ++row) {
        double* first = table.data() + row * width;
        least[row] = least_of(first, width);
        if (least[row] < forbidden)  // else the value before is forbidden and the row never asked for
          for (std::size_t v = 0; v < width; ++v) first[v] -= least[row];
        watch_.poll(2 * width);
      }
      Increment increment;
      increment.depth = scope[k];
      increment.earlier.assign(scope.begin(), scope.begin() + static_cast<std::ptrdiff_t>(k));
      increment.strides.assign(k, width);
      for (std::size_t i = k - 1; i-- > 0;) increment.strides[i] = increment.strides[i + 1] * domain(scope[i + 1]);
      increment.table = std::move(table);
      after[scope[k - 1]].push_back(std::move(increment));
      table = std::move(least);
    }
  }

  const FactorGraph& graph_;
  Watch& watch_;
};

}  // namespace toposcope::posterior
