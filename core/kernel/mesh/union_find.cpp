// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/union_find.h"

#include <atomic>
#include <numeric>
#include <utility>

#include "mesh/adjacency.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

/// Union-find of many threads: the root of each component is its least vertex, whoever comes first.
class SharedForest {
 public:
  explicit SharedForest(std::size_t count) : parent_(large_array<Index>(count)) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  Index find(Index v) {
    for (Index up = parent(v); up != v;) {
      const Index above = parent(up);
      std::atomic_ref(parent_[v]).compare_exchange_weak(up, above, std::memory_order_relaxed);
      v = above;
      up = parent(v);
    }
    return v;
  }

  void join(Index a, Index b) {
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      if (Index root = a; std::atomic_ref(parent_[a]).compare_exchange_strong(root, b)) return;
    }
  }

 private:
  Index parent(Index v) { return std::atomic_ref(parent_[v]).load(std::memory_order_relaxed); }

  std::vector<Index> parent_;
};

}  // namespace

std::vector<Index> connected_vertices(std::size_t vertices, std::span<const Triangle> triangles, Context* context,
                                      Index& count) {
  constexpr std::size_t grain = 1 << 14;
  SharedForest forest(vertices);
  for_chunks(context, triangles.size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      forest.join(triangles[f][0], triangles[f][1]);
      forest.join(triangles[f][1], triangles[f][2]);
    }
  });
  std::vector<Index> component = large_array<Index>(vertices);
  count = 0;
  for (Index v = 0; v < vertices; ++v) {
    const Index root = forest.find(v);
    component[v] = root == v ? count++ : component[root];
  }
  return component;
}

}  // namespace toposcope
