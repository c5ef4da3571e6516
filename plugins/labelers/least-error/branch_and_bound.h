// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Branch and bound that goes deep in short bursts and returns to the best open node (hybrid best-first search,
// Allouche, de Givry, Katsirelos, Schiex & Zytnicki 2015): good labellings early, a lower bound that rises all the
// while.

#include <cstdint>
#include <vector>

#include "consistency.h"

namespace toposcope::least_error {

struct Settings {
  int root_sweeps, node_sweeps;  ///< most sweeps of Consistency::spread
  bool virtual_consistency;      ///< at the root
};

class BranchAndBound {
 public:
  BranchAndBound(const LabelingProblem& problem, SoftNetwork& network, BestLabelings& best, std::size_t k_best,
                 const Settings& settings, Deadline& deadline, Context& context);

  /// \return true when no labelling better than the list is left
  bool search();
  /// No labelling that is not in the list costs less.
  double lower_bound() const { return lower_bound_; }
  std::uint64_t nodes() const { return nodes_; }
  double root_bound() const { return root_bound_; }

 private:
  struct Decision {
    int variable, value;
    bool assign;  ///< else removed
  };
  struct Open {
    Cost bound;
    std::uint64_t number;  ///< of its making: among equal bounds the latest goes first
    std::vector<Decision> path;
    bool operator<(const Open& other) const {
      return bound != other.bound ? bound > other.bound : number < other.number;
    }
  };

  Cost cutoff() const;
  bool restore(const std::vector<Decision>& path);
  void dive();
  bool root();
  bool apply(const Decision& decision);
  bool deduce();
  bool propagate();
  int choose_variable();
  int choose_value(int variable);
  void offer();
  void open(Cost bound);
  void report_bound();

  const LabelingProblem& problem_;
  SoftNetwork& network_;
  BestLabelings& best_;
  std::size_t k_best_;
  Settings settings_;
  Deadline& deadline_;
  Context& context_;
  Consistency consistency_;
  std::vector<Open> heap_;
  std::vector<Decision> path_;
  std::uint64_t nodes_ = 0, redone_ = 0, backtracks_ = 0, limit_ = 0, made_ = 0;
  std::uint64_t burst_ = 1;
  int last_conflict_ = -1;
  bool stopped_ = false;
  double lower_bound_ = -forbidden, root_bound_ = -forbidden;
  Labeling labeling_;
  std::vector<int> favourite_;  ///< values of the best labelling so far
};

}  // namespace toposcope::least_error
