// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

#include "toposcope/types.h"

namespace toposcope {

/// Of the coordinates' bits; -0 is 0.
inline std::uint64_t position_hash(const Vec3& point) {
  std::uint64_t hash = 0;
  for (const double coordinate : point) {  // SplitMix64's finalizer
    hash += std::bit_cast<std::uint64_t>(coordinate + 0.0) + 0x9e3779b97f4a7c15;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111eb;
    hash ^= hash >> 31;
  }
  return hash;
}

}  // namespace toposcope
