// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Depth-first search for the consistent labellings of a CrispNetwork (dissertation 3.4.2, backtracking tree search).

#include <cstdint>
#include <span>
#include <vector>

#include "toposcope/labeling/crisp_propagation.h"

namespace toposcope {

struct CrispRules {
  enum class Relaxation : std::uint8_t { none, before, maintained };
  enum class Order : std::uint8_t { weighted, smallest_domain, detectability };
  Relaxation relaxation = Relaxation::maintained;  ///< none: forward checking alone
  Order order = Order::weighted;                   ///< of the variables
  bool backjumping = true;
  Index missing_limit = no_candidate;  ///< at most so many variables missing
  bool missing_last = false;           ///< *missing* is tried after all candidates; else in the order of the costs
};

/// What a search asks and tells on its way.
class CrispVisitor {
 public:
  virtual ~CrispVisitor() = default;
  /// Orders the values left to a variable that is assigned next. May leave some out: those lead nowhere that matters.
  virtual void order(Index variable, std::vector<Index>& values) = 0;
  /// A value was assigned and its consequences drawn. \return false: nothing below this node matters
  virtual bool enter(Index variable, Index value) = 0;
  /// The assignment that `enter` was last told of, and not yet left, is taken back.
  virtual void leave(Index variable) = 0;
  /// A consistent labelling. \return false to end the search
  virtual bool solution(std::span<const Index> values) = 0;
};

/// Variables by the dissertation's strategy: relationships by the product of their features' detectabilities, within
/// each the most detectable feature first; those in no relationship last. Ties keep the problem's order.
std::vector<Index> detectability_order(const LabelingProblem& problem);

/// Chronological tree search with forward checking or maintained arc consistency, dynamic variable ordering
/// (dom/wdeg [Boussemart2004]) and conflict-directed backjumping [Prosser1993].
class CrispSearch {
 public:
  CrispSearch(const CrispNetwork& network, const CrispRules& rules, CrispVisitor& visitor, Deadline& deadline);

  enum class End : std::uint8_t { exhausted, ended_by_visitor, out_of_time };
  End run();

  /// Domains at the root (after relaxation) before and after `run`, at the present node within.
  const CrispDomains& domains() const { return domains_; }
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

  const CrispNetwork& network_;
  const CrispRules rules_;
  CrispVisitor& visitor_;
  Deadline& deadline_;
  CrispDomains domains_;
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

struct FirstConsistent {
  bool found = false;
  bool proven = false;  ///< that there is none; or, with fewest missing, that none has fewer missing
  std::vector<Index> values = {};
  std::uint64_t nodes = 0;
};

/// The first consistent labelling, values of least unary cost first. With `fewest_missing`, *missing* comes last, and
/// a labelling with fewer missing is asked for until there is none.
FirstConsistent first_consistent(const CrispNetwork& network, CrispRules rules, bool fewest_missing,
                                 Deadline& deadline);

/// Orders values by their unary cost, ties by number.
void order_by_cost(const LabelingVariable& variable, std::vector<Index>& values);

}  // namespace toposcope
