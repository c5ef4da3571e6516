// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/turn_coverage.h"

#include <algorithm>
#include <cmath>

#include "toposcope/types.h"

namespace toposcope {
namespace {

constexpr double least_bins = 32, bins_per_edge = 4, max_bins = 1 << 18;
constexpr double most_of_a_turn = 0.125;  // that one point stands for

}  // namespace

TurnCoverage::TurnCoverage(double turn)
    : filled_(static_cast<std::size_t>(std::clamp(std::round(turn * bins_per_edge), least_bins, max_bins)), 0) {}

// Marking only the bin that holds the point would leave gaps between points an edge apart.
void TurnCoverage::add(double angle, double turn) {
  const auto count = static_cast<std::ptrdiff_t>(filled_.size());
  const double position = angle / (2 * pi) + 0.5, width = std::min(1 / turn, most_of_a_turn);
  const auto bin = [&](double x) { return static_cast<std::ptrdiff_t>(std::floor(x * static_cast<double>(count))); };
  const std::ptrdiff_t first = bin(position - width / 2), last = std::min(bin(position + width / 2), first + count - 1);
  for (std::ptrdiff_t i = first; i <= last; ++i) filled_[static_cast<std::size_t>((i + count) % count)] = 1;
}

double TurnCoverage::part() const {
  return static_cast<double>(std::count(filled_.begin(), filled_.end(), 1)) / static_cast<double>(filled_.size());
}

}  // namespace toposcope
