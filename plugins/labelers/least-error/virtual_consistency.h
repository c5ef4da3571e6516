// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Virtual arc consistency (Cooper, de Givry, Sanchez, Schiex, Zytnicki & Werner 2010): arc consistency of the crisp
// problem of what costs (almost) nothing. Where it proves that problem inconsistent, its proof tells which costs to
// move for the constant to rise.

#include <cstdint>
#include <vector>

#include "soft_network.h"

namespace toposcope::least_error {

class VirtualConsistency {
 public:
  explicit VirtualConsistency(SoftNetwork& network);

  /// Raises the network's constant until virtual arc consistency holds at every threshold down to one unit, a step
  /// gains less than a unit, or time is out. Only before the first mark.
  void enforce(Cost cutoff, Deadline& deadline);

 private:
  struct Removed {
    int variable, value;
    int function, side;  ///< that left it without support; side of `variable`
  };

  int wiped_out(Cost threshold);
  void trace(int variable, Cost threshold);
  Cost step(int variable) const;
  void take(int variable, Cost step);
  Cost cost(const BinaryFunction& f, int a, int b) const;

  SoftNetwork& network_;
  std::vector<std::size_t> first_;  ///< of a variable's values in the arrays per value
  std::vector<std::size_t> block_;  ///< of a function's sides in moves_
  std::vector<char> alive_, wanted_;
  std::vector<std::int64_t> need_;  ///< per value: units asked of it for each unit gained
  std::vector<std::int64_t>
      moves_;  ///< per function, side and value: projected (+) or extended (-) for each unit gained
  std::vector<std::int64_t> extended_;
  std::vector<Removed> removed_;
  std::vector<int> queue_;
  std::vector<char> queued_;
};

}  // namespace toposcope::least_error
