// SPDX-License-Identifier: BSD-3-Clause
#include "flooding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace watershed {
namespace {

constexpr Index none = std::numeric_limits<Index>::max();

/// Disjoint sets, each with the lowest height in it.
class Pools {
 public:
  explicit Pools(std::size_t count) : parent_(count), lowest_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index find(Index x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  double& lowest(Index root) { return lowest_[root]; }
  /// The deeper one's root stays.
  Index join(Index a, Index b) {
    if (lowest_[b] < lowest_[a]) std::swap(a, b);
    parent_[b] = a;
    return a;
  }

 private:
  std::vector<Index> parent_;
  std::vector<double> lowest_;
};

std::vector<double> vertex_areas(const toposcope::MeshView& mesh) {
  std::vector<double> areas(mesh.vertex_count(), 0);
  for (const toposcope::Triangle& t : mesh.triangles) {
    const toposcope::Vec3& p = mesh.positions[t[0]];
    const double third = (mesh.positions[t[1]] - p).cross(mesh.positions[t[2]] - p).norm() / 6;
    for (const Index v : t) areas[v] += third;
  }
  return areas;
}

/// The pool of each vertex. A vertex on a divide goes to the pool of its lowest neighbour.
std::vector<Index> pools_of(const toposcope::MeshView& mesh, const std::vector<double>& height, double depth,
                            Pools& pools) {
  std::vector<Index> order(mesh.vertex_count());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index v, Index w) { return height[v] < height[w]; });
  std::vector<Index> pool(mesh.vertex_count(), none);
  for (const Index v : order) {
    Index lowest = none;
    for (const Index w : mesh.one_ring(v))
      if (pool[w] != none && (lowest == none || height[w] < height[lowest])) lowest = w;
    if (lowest == none) {
      pool[v] = v;
      pools.lowest(v) = height[v];
      continue;
    }
    pool[v] = pools.find(pool[lowest]);
    for (const Index w : mesh.one_ring(v)) {
      if (pool[w] == none) continue;
      const Index here = pools.find(pool[v]), there = pools.find(pool[w]);
      if (here == there) continue;
      if (height[v] - std::max(pools.lowest(here), pools.lowest(there)) < depth) pools.join(here, there);
    }
  }
  for (Index& p : pool) p = pools.find(p);
  return pool;
}

/// Joins pools that are too small, the smallest first, to the neighbour over the lowest pass.
void join_small(const toposcope::MeshView& mesh, const std::vector<double>& height, double least_area, Pools& pools,
                std::vector<Index>& pool) {
  const std::vector<double> areas = vertex_areas(mesh);
  for (;;) {
    std::map<Index, double> area;
    for (Index v = 0; v < pool.size(); ++v) area[pool[v] = pools.find(pool[v])] += areas[v];
    std::vector<std::pair<double, Index>> small;
    for (const auto& [root, size] : area)
      if (size < least_area) small.emplace_back(size, root);
    std::sort(small.begin(), small.end());
    bool joined = false;
    for (const auto& [size, root] : small) {
      // One after the other: what it was joined to may have grown meanwhile.
      double pass = std::numeric_limits<double>::infinity();
      Index other = none;
      for (Index v = 0; v < pool.size(); ++v) {
        if (pools.find(pool[v]) != root) continue;
        for (const Index w : mesh.one_ring(v))
          if (pools.find(pool[w]) != root && std::max(height[v], height[w]) < pass) {
            pass = std::max(height[v], height[w]);
            other = pools.find(pool[w]);
          }
      }
      if (other == none) continue;  // a piece of its own
      pools.join(root, other);
      joined = true;
      break;
    }
    if (!joined) return;
  }
}

}  // namespace

Basins flood(const toposcope::MeshView& mesh, const std::vector<double>& height, double depth, double least_area) {
  Pools pools(mesh.vertex_count());
  std::vector<Index> pool = pools_of(mesh, height, depth, pools);
  join_small(mesh, height, least_area, pools, pool);

  Basins basins;
  basins.of_vertex.assign(mesh.vertex_count(), none);
  const std::vector<double> areas = vertex_areas(mesh);
  std::map<Index, Index> number;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.faces_of(v).empty()) continue;
    const auto [entry, added] = number.try_emplace(pool[v], static_cast<Index>(number.size()));
    if (added) {
      basins.lowest.push_back(pools.lowest(pool[v]));
      basins.area.push_back(0);
    }
    basins.of_vertex[v] = entry->second;
    basins.area[entry->second] += areas[v];
  }
  return basins;
}

}  // namespace watershed
