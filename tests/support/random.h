// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "toposcope/types.h"

namespace toposcope::test {

/// The same numbers with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return radius * std::cos(uniform(0, 2 * pi));
  }
  bool chance(double p) { return uniform(0, 1) < p; }
  Index below(std::size_t n) { return static_cast<Index>(engine_() % n); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace toposcope::test
