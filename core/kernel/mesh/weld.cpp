// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/weld.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

std::uint64_t hash_of(const Vec3& point) {
  std::uint64_t hash = 0;
  for (const double coordinate : point) {  // SplitMix64's finalizer
    hash += std::bit_cast<std::uint64_t>(coordinate + 0.0) + 0x9e3779b97f4a7c15;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111eb;
    hash ^= hash >> 31;
  }
  return hash;
}

}  // namespace

std::vector<Index> first_at_same_place(std::span<const Vec3> points, const std::vector<bool>& among) {
  constexpr Index empty = std::numeric_limits<Index>::max();
  const auto asked = static_cast<std::size_t>(std::count(among.begin(), among.end(), true));
  const std::size_t size = std::bit_ceil(2 * asked + 1);
  std::vector<Index> slots = large_array<Index>(size, empty);
  std::vector<Index> first = large_array<Index>(points.size());
  for (Index v = 0; v < points.size(); ++v) {
    first[v] = v;
    if (!among[v] || !points[v].allFinite()) continue;
    std::size_t i = hash_of(points[v]) & (size - 1);
    while (slots[i] != empty && points[slots[i]] != points[v]) i = (i + 1) & (size - 1);
    if (slots[i] == empty)
      slots[i] = v;
    else
      first[v] = slots[i];
  }
  return first;
}

}  // namespace toposcope
