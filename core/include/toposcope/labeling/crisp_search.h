// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The crisp form of a labelling problem: arc consistency, and depth-first search for the consistent labellings
// (dissertation 3.4.2).

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "toposcope/labeling/tools.h"

namespace toposcope {

class CompiledNetwork;

/// A labelling problem compiled for propagation and search: what may stand together, as bits. A labelling that is
/// `consistent` is one that all of it allows. The problem must outlive it.
class CrispNetwork {
 public:
  /// \param all_present  no variable may be missing
  /// When the deadline is reached it stops early and is not `complete`.
  CrispNetwork(const LabelingProblem& problem, Deadline& deadline, bool all_present = false);
  ~CrispNetwork();
  CrispNetwork(const CrispNetwork&) = delete;
  CrispNetwork& operator=(const CrispNetwork&) = delete;

  /// That it was made of.
  const LabelingProblem& problem() const;
  /// False where the deadline came first.
  bool complete() const;
  /// False where a constraint's violations forbid what its costs do not: then consistent labellings are fewer than
  /// those of finite cost.
  bool by_cost_alone() const;

  /// How many.
  Index variables() const;
  /// How many values a variable has.
  Index domain(Index variable) const { return offsets_[variable + 1] - offsets_[variable]; }
  /// Position of a variable's first value among all values of all variables; `offset(variables())` is their number.
  Index offset(Index variable) const { return offsets_[variable]; }

  /// For the library itself.
  const CompiledNetwork& compiled() const { return *compiled_; }

 private:
  std::unique_ptr<const CompiledNetwork> compiled_;
  const Index* offsets_;
};

/// What is left of each variable's values, at any moment. Owned by who changes it.
class CrispDomains {
 public:
  /// For the library itself: views of what it keeps.
  CrispDomains(const std::uint64_t* words, const std::size_t* offsets, const Index* sizes, const char* assigned)
      : words_(words), offsets_(offsets), sizes_(sizes), assigned_(assigned) {}
  /// As bits: see `for_each_value`.
  std::span<const std::uint64_t> domain(Index variable) const {
    return {words_ + offsets_[variable], words_ + offsets_[variable + 1]};
  }
  /// How many values are left.
  Index size(Index variable) const { return sizes_[variable]; }
  /// Whether the search has given the variable its one value.
  bool assigned(Index variable) const { return assigned_[variable] != 0; }

 private:
  const std::uint64_t* words_;
  const std::size_t* offsets_;
  const Index* sizes_;
  const char* assigned_;
};

/// Steps through the values of a set in ascending order:
///   for_each_value(domains.domain(variable), [&](Index value) { ... });
template <class Body>
void for_each_value(std::span<const std::uint64_t> words, const Body& body) {
  for (std::size_t w = 0; w < words.size(); ++w)
    for (std::uint64_t rest = words[w]; rest != 0; rest &= rest - 1)
      body(static_cast<Index>(w * 64 + static_cast<std::size_t>(__builtin_ctzll(rest))));
}

/// Generalised arc consistency: removes each value that nothing left of another variable can stand with. The fixpoint
/// does not depend on any order.
class ArcConsistency {
 public:
  /// The network must outlive it.
  ArcConsistency(const CrispNetwork& network, Deadline& deadline);
  ~ArcConsistency();
  ArcConsistency(const ArcConsistency&) = delete;
  ArcConsistency& operator=(const ArcConsistency&) = delete;

  /// \pre network.complete()
  /// Stopped by the deadline the domains are left too large. \return false where a domain is empty
  bool relax();
  /// As they are now.
  const CrispDomains& domains() const;
  /// In the order in which they were removed, each with its reason: first those of infinite cost or that a constraint
  /// over the variable alone forbids. *Missing* is not among them where all must be present.
  std::vector<RemovedValue> removed() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// How a search goes about it.
struct CrispRules {
  /// When arc consistency is made: never (forward checking alone), before the search, at every node.
  enum class Relaxation : std::uint8_t { none, before, maintained };
  /// Which variable is next: smallest domain over weight of failures, smallest domain, `detectability_order`.
  enum class Order : std::uint8_t { weighted, smallest_domain, detectability };
  Relaxation relaxation = Relaxation::maintained;  ///< when
  Order order = Order::weighted;                   ///< of the variables
  bool backjumping = true;                         ///< goes back at once to a decision that is to blame for a failure
  Index missing_limit = no_candidate;              ///< at most so many variables missing
  bool missing_last = false;  ///< *missing* is tried after all candidates; else in the order of the costs
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
  /// All must outlive it.
  CrispSearch(const CrispNetwork& network, const CrispRules& rules, CrispVisitor& visitor, Deadline& deadline);
  ~CrispSearch();
  CrispSearch(const CrispSearch&) = delete;
  CrispSearch& operator=(const CrispSearch&) = delete;

  /// Why a search ended: all was visited, the visitor wanted no more, the deadline came.
  enum class End : std::uint8_t { exhausted, ended_by_visitor, out_of_time };
  /// Once.
  End run();

  /// At the root (after relaxation) before and after `run`, at the present node within.
  const CrispDomains& domains() const;
  /// Values tried.
  std::uint64_t nodes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What `first_consistent` found.
struct FirstConsistent {
  bool found = false;              ///< there is a labelling
  bool proven = false;             ///< that there is none; or, with fewest missing, that none has fewer missing
  std::vector<Index> values = {};  ///< the labelling, a value per variable
  std::uint64_t nodes = 0;         ///< values tried
};

/// The first consistent labelling, values of least unary cost first. With `fewest_missing`, *missing* comes last, and
/// a labelling with fewer missing is asked for until there is none.
FirstConsistent first_consistent(const CrispNetwork& network, CrispRules rules, bool fewest_missing,
                                 Deadline& deadline);

/// Orders values by their unary cost, ties by number.
void order_by_cost(const LabelingVariable& variable, std::vector<Index>& values);

}  // namespace toposcope
