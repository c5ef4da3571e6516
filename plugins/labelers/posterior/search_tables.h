// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A factor graph made ready for depth-first search: variables in the order in which they enter the tree, every factor
// cut into increments that only ever add to a lower bound of the cost.

#include <algorithm>
#include <vector>

#include "toposcope/labeling/factor_graph.h"
#include "toposcope/labeling/watch.h"

namespace toposcope::posterior {

using namespace factors;

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
  SearchTables(const FactorGraph& graph, std::vector<Index> search_order, Watch& watch);

  Index depths() const { return static_cast<Index>(order.size()); }
  std::size_t domain(Index depth) const { return offsets[depth + 1] - offsets[depth]; }

  /// No labelling costs less, but for rounding.
  double bound() const;

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

  void add_increments(const std::vector<Index>& scope, std::vector<double> table);

  const FactorGraph& graph_;
  Watch& watch_;
};

}  // namespace toposcope::posterior
