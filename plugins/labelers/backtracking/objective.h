// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What consistent labellings are ranked by, as tables made ready for bounds at the nodes of a tree whose variables come
// in any order.

#include <span>
#include <vector>

#include "toposcope/labeling/crisp_search.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::backtracking {

/// Sum of the counted violations in the problem's order.
double violation_of(const LabelingProblem& problem, std::span<const Index> values);

/// A constraint's values of the objective. What each value of its first variable (in search order) costs at least is
/// counted with that value, so that the table says only what comes on top: nowhere less than 0.
struct Part {
  std::vector<Index> scope;          ///< the constraint's order
  std::vector<std::size_t> strides;  ///< in `table`
  std::vector<double> table;
};

/// One additive objective, the costs or the violations. Infinite where the crisp form forbids.
class Objective {
 public:
  /// \return false when the deadline came first
  bool make(const CrispNetwork& network, bool violations, std::span<const Index> order, Deadline& deadline);

  std::vector<double> unary;  ///< at CrispNetwork::offset
  std::vector<Part> parts;
  std::vector<std::vector<Index>> parts_of;
  double slack = 0;  ///< more than the rounding of any sum

 private:
  bool direct(const CrispNetwork& network, std::span<const Index> order, std::span<const Index> rank,
              Deadline& deadline);
};

/// Bounds of an objective along a path of the tree: what the assigned variables cost, and for each value of the others
/// what it would add. Every assignment at once tells the variables that it leaves alone in a constraint.
class Bounds {
 public:
  Bounds(const Objective& objective, const CrispNetwork& network);

  /// What the value would add to the assigned ones.
  double of(Index variable, Index value) const { return levels_[depth_][network_.offset(variable) + value]; }
  /// Least sum of all that the domains still admit; of one variable nothing is counted.
  double bound(const CrispDomains& domains, Index without = no_candidate) const;
  double least(const CrispDomains& domains, Index variable) const;

  void enter(const CrispDomains& domains, Index variable, Index value);
  void leave() { --depth_; }

 private:
  const Objective& objective_;
  const CrispNetwork& network_;
  std::vector<std::vector<double>> levels_;
  std::vector<double> sums_;
  std::vector<Index> values_;
  std::size_t depth_ = 0;
};

}  // namespace toposcope::backtracking
