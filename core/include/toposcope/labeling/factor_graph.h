// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A labelling problem as a factor graph over the values that can still occur: unary costs, and tables over two or more
// variables. Exclusions are tables over those pairs of variables whose candidates conflict.

#include <functional>
#include <span>
#include <vector>

#include "toposcope/labeling/tools.h"
#include "toposcope/labeling/watch.h"

namespace toposcope::factors {

/// Costs over two or more variables, row-major, the last of the scope fastest.
struct Factor {
  std::vector<Index> scope;
  std::span<const double> costs;  ///< `own`, or a table of the problem's
  std::vector<double> own = {};
};

struct FactorGraph {
  std::vector<std::vector<Index>> values;  ///< per variable: the problem's values that are left, ascending
  std::vector<std::vector<double>> unary;  ///< per variable, per value left: finite
  std::vector<Factor> factors;             ///< several may have the same variables
  double constant = 0;
  bool impossible = false;  ///< a variable has no value left: no labelling has a finite cost

  Index variables() const { return static_cast<Index>(values.size()); }
  std::size_t domain(Index variable) const { return values[variable].size(); }
};

/// Entries of all tables, and unary costs.
double entries(const FactorGraph& graph);

/// No labelling costs less, but for rounding: the least of every table, summed.
double lower_bound(const FactorGraph& graph);

/// Takes a labelling as positions among the graph's values.
using Offer = std::function<void(const std::vector<Index>&)>;

/// Adds a factor's table to one over the same variables in another order. An empty one is made. \throw OutOfTime
void add_reordered(const FactorGraph& graph, const Factor& factor, const std::vector<Index>& scope,
                   std::vector<double>& table, Watch& watch);

/// The same costs in one factor for each set of variables. \throw OutOfTime
FactorGraph merged(const FactorGraph& graph, Watch& watch);

/// Values, scopes and sizes of tables, as far as they can be told without reading tables: enough to plan an
/// elimination. \pre the problem outlives the graph
FactorGraph skeleton(const LabelingProblem& problem);

/// \pre the problem outlives the graph \throw OutOfTime
FactorGraph factor_graph(const LabelingProblem& problem, Watch& watch);

}  // namespace toposcope::factors
