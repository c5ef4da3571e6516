// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Soft local consistencies (Larrosa & Schiex 2004; de Givry, Heras, Zytnicki & Larrosa 2005): node, arc, full
// directional and existential directional arc consistency, EDAC*, kept by moving costs towards the constant.

#include <vector>

#include "soft_network.h"

namespace toposcope::least_error {

class Consistency {
 public:
  Consistency(SoftNetwork& network, Deadline& deadline);

  /// Everything is to be looked at again.
  void touch_all();
  void assign(int variable, int value);
  void remove(int variable, int value);
  /// \return false: no labelling below the cutoff is left. True also where time ran out (`interrupted`): what was done
  /// until then stands.
  bool propagate(Cost cutoff);
  bool interrupted() const { return interrupted_; }

  /// Spreads unary costs evenly over the functions of the variables that come later, then earlier, taking what all
  /// values of a variable share to the constant (sequential tree-reweighted message passing, Kolmogorov 2006, as moves
  /// of costs). Ends when a sweep gains less than `least_gain` of what is missing to the cutoff. \return false: no
  /// labelling below the cutoff is left
  bool spread(Cost cutoff, int sweeps, double least_gain);

  /// Value that costs least, by itself and together with the best of each neighbour.
  int support(int variable);
  Cost level(int value) const { return level_[static_cast<std::size_t>(value)]; }

 private:
  enum class Order { any, greatest_first, least_first };
  /// Of variables, each once.
  class Queue {
   public:
    Queue(Order order, std::size_t variables) : order_(order), in_(variables, 0) {}
    void push(int variable);
    bool empty() const { return heap_.empty(); }
    int pop();
    void clear();

   private:
    Order order_;
    std::vector<char> in_;
    std::vector<int> heap_;  ///< greatest first; of keys: the variable, or minus the variable
  };

  bool node_consistent(int variable);
  bool all_node_consistent();
  bool lose(int variable, int value);
  bool simple_supports(int function, int side);
  bool full_supports(int function, int side);
  Cost gather(int variable, bool earlier_only);
  bool existential_support(int variable);
  bool settle(int variable, bool raised);
  bool out_of_time();
  void forget();
  const Cost* weights(int function, int other_side, bool with_unary);
  Cost row_least(const BinaryFunction& f, int side, int value, const Cost* weight) const;
  bool run();
  bool spread_from(int variable, bool to_later);

  SoftNetwork& network_;
  Deadline& deadline_;
  bool interrupted_ = false;
  std::uint32_t steps_ = 0;
  Cost cutoff_ = 0;
  Cost seen_constant_ = 0;
  Queue arc_, directional_, existential_;
  std::vector<int> fresh_;  ///< variables that were assigned and have not told
  std::vector<Cost> weight_, need_, level_, gain_;
};

}  // namespace toposcope::least_error
