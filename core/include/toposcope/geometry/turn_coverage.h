// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace toposcope {

/// The part of a turn that has points.
class TurnCoverage {
 public:
  /// \param turn  length of the turn, in mean edges
  explicit TurnCoverage(double turn);
  /// A point stands for an edge length of arc about itself.
  /// \param angle  rad, -pi to pi
  /// \param turn   as above, at the point
  void add(double angle, double turn);
  /// 0 to 1.
  double part() const;

 private:
  std::vector<char> filled_;
};

}  // namespace toposcope
