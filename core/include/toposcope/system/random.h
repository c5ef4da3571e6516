// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Seeded random numbers that are the same on every machine and with every standard library.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "toposcope/types.h"

namespace toposcope {

/// Splitmix64 [Steele2014] as a function of a counter or seed: neighbouring numbers become unrelated.
constexpr std::uint64_t splitmix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Splitmix64 as a stream of 64 random bits a call, a generator of the standard library's kind.
class SplitMix64 {
 public:
  using result_type = std::uint64_t;  ///< of the standard library's generators
  /// By which the state grows.
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15ULL;

  /// Streams whose states differ by few times `step` overlap.
  constexpr explicit SplitMix64(std::uint64_t state) : state_(state) {}
  /// The least number.
  static constexpr result_type min() { return 0; }
  /// The greatest number.
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }
  /// The next number.
  constexpr result_type operator()() {
    const std::uint64_t before = state_;
    state_ += step;
    return splitmix64(before);
  }

 private:
  std::uint64_t state_;
};

/// Knuth's linear congruential generator (MMIX), whose upper 31 bits are given; enough for choosing samples.
class LinearCongruential {
 public:
  /// The same state gives the same numbers.
  constexpr explicit LinearCongruential(std::uint64_t state = 0x9e3779b97f4a7c15ULL) : state_(state) {}
  /// The next number, 31 bits.
  constexpr std::uint32_t operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::uint32_t>(state_ >> 33);
  }
  /// \return a number below `n`, which is above 0 and far below 2^31
  constexpr std::size_t below(std::size_t n) { return (*this)() % n; }

 private:
  std::uint64_t state_;
};

/// 64 random bits as a number in [0, 1), a multiple of 2^-53.
constexpr double uniform_closed_open(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// 64 random bits as a number in (0, 1].
constexpr double uniform_open_closed(std::uint64_t bits) {
  return static_cast<double>((bits >> 11) + 1) * 0x1p-53;
}

/// 64 random bits as a number in (0, 1), in the middle of a step of 2^-53; the last one rounds to 1.
constexpr double uniform_open(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

/// Two independent standard normal numbers [Box1958] from two uniform ones, `u` in (0, 1] and `v` in [0,
/// 1].
inline std::array<double, 2> normal_pair(double u, double v) {
  const double radius = std::sqrt(-2 * std::log(u)), angle = 2 * pi * v;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace toposcope
