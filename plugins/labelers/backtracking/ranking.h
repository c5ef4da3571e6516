// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The k best consistent labellings, and the branch and bound that finds them.

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "objective.h"
#include "toposcope/labeling/crisp_search.h"

namespace toposcope::backtracking {

/// A labelling with what it is ranked by; ties are broken by the values.
struct Ranked {
  double violation = 0;  ///< 0 where the rank is the cost alone
  Labeling labeling;
  bool operator<(const Ranked& other) const;
};

/// The k best of those offered, best first. Offering one twice keeps it once.
class RankedList {
 public:
  /// \param within  of the best one's cost \param cost_limit  of any
  RankedList(std::size_t capacity, double within, double cost_limit);
  void offer(const Ranked& ranked);
  double cost_limit() const;
  /// True where nothing with these bounds can enter.
  bool hopeless(double violation, double violation_slack, double cost, double cost_slack) const;
  const std::vector<Ranked>& list() const { return list_; }

 private:
  std::size_t capacity_;
  double within_, cost_limit_;
  std::vector<Ranked> list_;
};

/// Ranks a labelling by its sums in the problem's order, the same by whichever path it was found.
Ranked ranked(const LabelingProblem& problem, std::span<const Index> values, bool by_violation);

/// Visits every consistent labelling, the values of least cost first.
class Counter final : public CrispVisitor {
 public:
  Counter(const LabelingProblem& problem, bool by_violation, RankedList& list);

  void order(Index variable, std::vector<Index>& values) override;
  bool enter(Index, Index) override { return true; }
  void leave(Index) override {}
  bool solution(std::span<const Index> values) override;
  std::uint64_t count() const { return count_; }

 private:
  const LabelingProblem& problem_;
  bool by_violation_;
  RankedList& list_;
  std::uint64_t count_ = 0;
};

/// Leaves out what cannot enter the list.
class BranchAndBound final : public CrispVisitor {
 public:
  /// \param violation  null where the rank is the cost alone
  BranchAndBound(const CrispNetwork& network, const Objective& cost, const Objective* violation, RankedList& list);

  void follow(const CrispDomains& domains) { domains_ = &domains; }
  void order(Index variable, std::vector<Index>& values) override;
  bool enter(Index variable, Index value) override;
  void leave(Index variable) override;
  bool solution(std::span<const Index> values) override;

 private:
  struct Child {
    double violation, cost;
    Index value;
    bool operator<(const Child& o) const {
      return std::tie(violation, cost, value) < std::tie(o.violation, o.cost, o.value);
    }
  };

  bool hopeless(double violation, double cost) const;

  const CrispNetwork& network_;
  const Objective& cost_objective_;
  Bounds cost_;
  double violation_slack_;
  bool by_violation_;
  Bounds violation_;
  RankedList& list_;
  const CrispDomains* domains_ = nullptr;
  std::vector<Child> children_;
};

}  // namespace toposcope::backtracking
