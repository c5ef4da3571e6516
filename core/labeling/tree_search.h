// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Depth-first search for the consistent labellings of a CompiledNetwork (dissertation 3.4.2, backtracking tree search).

#include <cstdint>
#include <vector>

#include "crisp_propagation.h"

namespace toposcope {

/// Chronological tree search with forward checking or maintained arc consistency, dynamic variable ordering
/// (dom/wdeg [Boussemart2004]) and conflict-directed backjumping [Prosser1993].
class TreeSearch {
 public:
  TreeSearch(const CompiledNetwork& network, const CrispRules& rules, CrispVisitor& visitor, Deadline& deadline);

  using End = CrispSearch::End;
  End run();

  /// Domains at the root (after relaxation) before and after `run`, at the present node within.
  const Propagation& propagation() const { return domains_; }
  /// Values tried.
  std::uint64_t nodes() const { return nodes_; }

 private:
  bool root();
  bool descend(std::size_t depth);
  bool propagate(Index variable);
  Index choose() const;
  double weight(Index variable) const;
  void list_values(std::size_t depth, Index variable);
  void blame_all(std::size_t depth);

  const CompiledNetwork& network_;
  const CrispRules rules_;
  CrispVisitor& visitor_;
  Deadline& deadline_;
  Propagation domains_;
  std::vector<Index> rank_;  ///< of each variable in the static order
  std::vector<double> pair_weights_, table_weights_;
  std::vector<Index> values_;
  std::vector<std::vector<Index>> children_;
  std::vector<VariableSet> conflicts_;  ///< per depth: the decisions to blame for what failed there
  VariableSet decisions_;
  End end_ = End::exhausted;
  std::uint64_t nodes_ = 0;
};

/// Ends the search at the first labelling that it meets, values of least unary cost first.
class FirstFound final : public CrispVisitor {
 public:
  /// \param found  receives the values; left alone where there is no labelling
  FirstFound(const LabelingProblem& problem, std::vector<Index>& found) : problem_(problem), found_(found) {}
  void order(Index variable, std::vector<Index>& values) override;
  bool enter(Index, Index) override { return true; }
  void leave(Index) override {}
  bool solution(std::span<const Index> values) override;

 private:
  const LabelingProblem& problem_;
  std::vector<Index>& found_;
};

}  // namespace toposcope
