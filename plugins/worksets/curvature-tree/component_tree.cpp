// SPDX-License-Identifier: BSD-3-Clause
#include "component_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace component_tree {
namespace {

constexpr double step = 0.02;
constexpr Index none = std::numeric_limits<Index>::max();

/// Union-find whose components are linked lists that only grow at their tail, so that the vertices of a component as
/// it was at the end of an earlier level are still the first ones from its head.
class Forest {
 public:
  explicit Forest(Index count) : parent_(count, none), next_(count, none), tail_(count), size_(count, 1) {}

  bool contains(Index v) const { return parent_[v] != none; }
  void insert(Index v) {
    parent_[v] = v;
    tail_[v] = v;
  }
  Index find(Index v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  /// Both roots; `b` is appended to `a`.
  void join(Index a, Index b) {
    parent_[b] = a;
    next_[tail_[a]] = b;
    tail_[a] = tail_[b];
    size_[a] += size_[b];
  }
  Index size(Index root) const { return size_[root]; }
  void copy(Index head, Index count, std::vector<Index>& out) const {
    out.clear();
    for (Index v = head; count > 0; --count, v = next_[v]) out.push_back(v);
  }

 private:
  std::vector<Index> parent_, next_, tail_, size_;
};

/// What is remembered of each root between levels.
struct Growth {
  Index size_before = 0;    ///< at the end of the previous level in which it changed
  double level_before = 0;  ///< of that level
  Index size_offered = 0;   ///< when last offered
  Index offered = none;     ///< index into the result, none if never
};

}  // namespace

std::vector<Component> components(const toposcope::MeshView& mesh, const std::vector<double>& field,
                                  const Limits& limits) {
  const Index count = mesh.vertex_count();
  std::vector<std::int32_t> level(count);
  for (Index v = 0; v < count; ++v) level[v] = static_cast<std::int32_t>(std::floor(field[v] / step));
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return level[a] > level[b]; });

  // Before a merger a stage is worth offering for less growth than between mergers.
  const double merge_growth = 1 + (limits.growth - 1) / 4;
  Forest forest(count);
  std::vector<Growth> growth(count);
  std::vector<Component> result;
  std::vector<double> level_of;  // of each result
  std::vector<Index> touched;

  const auto offer = [&](Index head, Index size, double at) {
    if (size < limits.min_vertices || size > limits.max_vertices) return;
    Component& component = result.emplace_back();
    forest.copy(head, size, component.vertices);
    level_of.push_back(at);
    component.saliency = -1;
    growth[head].size_offered = size;
    growth[head].offered = static_cast<Index>(result.size() - 1);
  };
  // The last stage offered is judged by how far the field fell until now.
  const auto settle = [&](Index head, double now) {
    if (growth[head].offered == none) return;
    Component& component = result[growth[head].offered];
    if (component.saliency < 0) component.saliency = 1 - std::exp(-(level_of[growth[head].offered] - now));
  };

  for (Index begin = 0; begin < count;) {
    Index end = begin;
    while (end < count && level[order[end]] == level[order[begin]]) ++end;
    const double now = level[order[begin]] * step;
    touched.clear();
    for (Index i = begin; i < end; ++i) forest.insert(order[i]);
    for (Index i = begin; i < end; ++i) {
      const Index v = order[i];
      for (Index q : mesh.one_ring(v)) {
        if (!forest.contains(q)) continue;
        Index a = forest.find(v), b = forest.find(q);
        if (a == b) continue;
        // The component with the longer past keeps its head; of equals the older.
        if (growth[a].size_before < growth[b].size_before ||
            (growth[a].size_before == growth[b].size_before &&
             std::tie(growth[a].size_offered, growth[a].level_before, b) <
                 std::tie(growth[b].size_offered, growth[b].level_before, a)))
          std::swap(a, b);
        if (growth[b].size_before >= limits.min_vertices) {  // two components with a past meet: both as they were
          for (Index head : {a, b}) {
            Growth& past = growth[head];
            if (past.size_before >= merge_growth * past.size_offered) {
              settle(head, past.level_before);
              offer(head, past.size_before, past.level_before);
            }
            settle(head, now);
          }
        }
        forest.join(a, b);
        touched.push_back(a);
      }
      touched.push_back(forest.find(v));
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (Index root : touched) {
      if (forest.find(root) != root) continue;
      Growth& past = growth[root];
      const Index size = forest.size(root);
      const double due = std::max<double>(limits.min_vertices, limits.growth * past.size_offered);
      if (size >= due) {
        settle(root, now);
        offer(root, size, now);
      }
      past.size_before = size;
      past.level_before = now;
    }
    begin = end;
  }
  for (Component& component : result) component.saliency = std::max(component.saliency, 0.0);

  for (Component& component : result) std::sort(component.vertices.begin(), component.vertices.end());
  // A large set that stands out a little tells as much as a small one that stands out a lot.
  const auto worth = [](const Component& c) { return c.saliency * std::sqrt(static_cast<double>(c.vertices.size())); };
  const auto better = [&](const Component& a, const Component& b) {
    if (worth(a) != worth(b)) return worth(a) > worth(b);
    if (a.vertices.size() != b.vertices.size()) return a.vertices.size() > b.vertices.size();
    return a.vertices.front() < b.vertices.front();
  };
  std::sort(result.begin(), result.end(), better);
  if (result.size() > limits.max_components) result.resize(limits.max_components);
  return result;
}

}  // namespace component_tree
