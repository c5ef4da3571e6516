// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesh/weld.h"

namespace toposcope {
namespace {

constexpr double reach = 1e-3;          // of the shortest edge: no distance that a surface is made of
constexpr std::size_t most_pairs = 64;  // a point, on average: more is no surface but a cloud
constexpr double gap = 10;              // between what is joined and what is not

using Cell = std::array<double, 3>;  // whole numbers, which may be too large for integers

struct Pair {
  double distance;
  Index a, b;
};

/// All pairs nearer than `limit`, in no order. Points sorted into cells of that size; work in proportion to the pairs.
std::vector<Pair> near_pairs(std::span<const Vec3> points, const std::vector<bool>& among, double limit) {
  if (!(limit > 0) || !std::isfinite(limit)) return {};
  const auto cell_of = [&](const Vec3& p) {
    return Cell{std::floor(p.x() / limit), std::floor(p.y() / limit), std::floor(p.z() / limit)};
  };
  std::vector<std::pair<Cell, Index>> cells;
  for (Index v = 0; v < points.size(); ++v)
    if (among[v] && points[v].allFinite()) cells.emplace_back(cell_of(points[v]), v);
  std::sort(cells.begin(), cells.end());
  std::vector<Pair> pairs;
  for (const auto& [cell, v] : cells) {
    if (pairs.size() > most_pairs * cells.size()) return {};
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {  // three cells above each other are neighbours in the row
        const Cell low = {cell[0] + x, cell[1] + y, cell[2] - 1}, high = {low[0], low[1], cell[2] + 1};
        for (auto at = std::lower_bound(cells.begin(), cells.end(), std::pair(low, Index{0}));
             at != cells.end() && at->first <= high; ++at)
          if (const double d = (points[v] - points[at->second]).norm(); v < at->second && d < limit)
            pairs.push_back({d, v, at->second});
      }
  }
  return pairs;
}

}  // namespace

NearPlaces first_at_near_place(std::span<const Vec3> points, const std::vector<bool>& among, double shortest_edge) {
  NearPlaces near;
  near.first.resize(points.size());
  std::iota(near.first.begin(), near.first.end(), Index{0});
  std::vector<Pair> pairs = near_pairs(points, among, reach * shortest_edge);
  const auto nearer = [](const Pair& a, const Pair& b) {
    return std::pair(a.distance, std::pair(a.a, a.b)) < std::pair(b.distance, std::pair(b.a, b.b));
  };
  std::sort(pairs.begin(), pairs.end(), nearer);
  if (pairs.empty() || gap * pairs.back().distance > reach * shortest_edge) return near;
  near.distance = pairs.back().distance;
  const auto root = [&](Index v) {
    while (near.first[v] != v) v = near.first[v] = near.first[near.first[v]];
    return v;
  };
  for (const Pair& pair : pairs) {
    const Index one = root(pair.a), other = root(pair.b), low = std::min(one, other), high = std::max(one, other);
    near.joined += low != high;
    near.first[high] = low;
  }
  for (Index v = 0; v < near.first.size(); ++v) near.first[v] = root(v);
  return near;
}

}  // namespace toposcope
