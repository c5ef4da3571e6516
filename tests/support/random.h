// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

#include "toposcope/system/random.h"
#include "toposcope/types.h"

namespace toposcope::test {

/// The same numbers with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * uniform_closed_open(engine_()); }
  double normal() {
    const double u = 1 - uniform(0, 1);
    return normal_pair(u, uniform(0, 1))[0];
  }
  bool chance(double p) { return uniform(0, 1) < p; }
  Index below(std::size_t n) { return static_cast<Index>(engine_() % n); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace toposcope::test
