// SPDX-License-Identifier: BSD-3-Clause
#include "component_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <tuple>

#include "toposcope/geometry/large_array.h"

namespace component_tree {
namespace {

constexpr Index none = std::numeric_limits<Index>::max();

/// What is remembered of each root between levels.
struct Past {
  Index size;          ///< at the end of the previous level in which it changed
  std::int32_t level;  ///< of that level
  Index offered_size;  ///< when last offered
  Index offered;       ///< index of that offer, none if never
};

/// Union-find whose components are linked lists that only grow at their tail: the vertices of a component as it was at
/// the end of an earlier level are for ever the first ones from its head.
class Forest {
 public:
  explicit Forest(Index count) : nodes_(std::make_unique_for_overwrite<Node[]>(count)), count_(count) {
    toposcope::advise_huge_pages(nodes_.get(), count * sizeof(Node));
  }

  void insert(Index v) { nodes_[v] = {v, none, v, 1, {0, 0, 0, none}}; }
  Index find(Index v) {
    while (nodes_[v].parent != v) v = nodes_[v].parent = nodes_[nodes_[v].parent].parent;
    return v;
  }
  /// Both roots; `b` is appended to `a`.
  void join(Index a, Index b) {
    nodes_[b].parent = a;
    nodes_[nodes_[a].tail].next = b;
    nodes_[a].tail = nodes_[b].tail;
    nodes_[a].size += nodes_[b].size;
  }
  Index size(Index root) const { return nodes_[root].size; }
  Past& past(Index root) { return nodes_[root].past; }

  /// Walks along a component's list; what is behind it need not be walked again for a later stage of the component.
  class Walk {
   public:
    explicit Walk(const Forest& forest) : forest_(forest), marks_(forest.count_ / 64 + 1, 0) {}

    /// The first `count` vertices from a head, ascending. Of calls with one head, in a row, each wants no fewer.
    void first(Index head, Index count, Index* out) {
      if (head != head_) {
        std::fill(marks_.begin(), marks_.end(), 0);
        head_ = next_ = head;
        walked_ = 0;
      }
      for (; walked_ < count; ++walked_, next_ = forest_.nodes_[next_].next)
        marks_[next_ / 64] |= std::uint64_t{1} << next_ % 64;
      for (std::size_t word = 0; count > 0; ++word)
        for (std::uint64_t bits = marks_[word]; bits != 0; bits &= bits - 1, --count)
          *out++ = static_cast<Index>(64 * word + static_cast<std::size_t>(std::countr_zero(bits)));
    }

   private:
    const Forest& forest_;
    std::vector<std::uint64_t> marks_;
    Index head_ = none, next_ = none, walked_ = 0;
  };

 private:
  struct Node {  // together: a visit touches one line of the cache
    Index parent, next, tail, size;
    Past past;
  };
  std::unique_ptr<Node[]> nodes_;  ///< of a vertex when it has been inserted
  Index count_;
};

/// A component as it was at one level: the first vertices from its head.
struct Offer {
  Index head, size;
  std::int32_t level;
  double saliency = -1;  ///< not yet known: the component has not changed since

  /// A large set that stands out a little tells as much as a small one that stands out a lot.
  double worth() const { return saliency * std::sqrt(static_cast<double>(size)); }
};

/// Vertices by level, descending; within a level ascending.
std::vector<Index> sorted_by_level(const Levels& level) {
  const auto [low, high] = std::minmax_element(level.begin(), level.end());
  const std::int32_t top = *high;
  std::vector<Index> place(static_cast<std::size_t>(std::int64_t{top} - *low) + 2, 0);
  for (std::int32_t l : level) ++place[static_cast<std::size_t>(top - l) + 1];
  for (std::size_t i = 1; i < place.size(); ++i) place[i] += place[i - 1];
  std::vector<Index> order = toposcope::large_array<Index>(level.size());
  for (Index v = 0; v < level.size(); ++v) order[place[static_cast<std::size_t>(top - level[v])]++] = v;
  return order;
}

/// Floods the mesh from the highest level down and collects the stages that are worth offering.
class Flood {
 public:
  Flood(const toposcope::MeshView& mesh, const Levels& level, double step, const Limits& limits)
      : mesh_(mesh), level_(level), step_(step), limits_(limits), forest_(mesh.vertex_count()) {}

  void run() {
    const std::vector<Index> order = sorted_by_level(level_);
    for (std::size_t begin = 0; begin < order.size();) {
      std::size_t end = begin;
      while (end < order.size() && level_[order[end]] == level_[order[begin]]) ++end;
      enter(std::span(order).subspan(begin, end - begin), level_[order[begin]]);
      begin = end;
    }
  }

  Components best() {
    for (Offer& offer : offers_) offer.saliency = std::max(offer.saliency, 0.0);
    const auto better = [](const Offer& a, const Offer& b) {
      return std::tuple(-a.worth(), b.size, a.head) < std::tuple(-b.worth(), a.size, b.head);
    };
    const std::size_t kept = std::min(offers_.size(), limits_.max_components);
    std::partial_sort(offers_.begin(), offers_.begin() + static_cast<std::ptrdiff_t>(kept), offers_.end(), better);
    offers_.resize(kept);
    Components components;
    for (const Offer& offer : offers_) {
      components.offsets.push_back(components.offsets.back() + offer.size);
      components.saliency.push_back(offer.saliency);
    }
    components.vertices = toposcope::large_array<Index>(components.offsets.back());
    // Stage by stage of each component.
    std::vector<std::size_t> order(kept);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::tuple(offers_[a].head, offers_[a].size, a) < std::tuple(offers_[b].head, offers_[b].size, b);
    });
    Forest::Walk walk(forest_);
    for (std::size_t i : order)
      walk.first(offers_[i].head, offers_[i].size, components.vertices.data() + components.offsets[i]);
    return components;
  }

 private:
  void enter(std::span<const Index> vertices, std::int32_t now) {
    changed_.clear();
    for (Index v : vertices) forest_.insert(v);
    for (Index v : vertices) {
      for (Index q : mesh_.one_ring(v))
        if (level_[q] >= now) meet(forest_.find(v), forest_.find(q), now);
      changed_.push_back(forest_.find(v));
    }
    for (Index root : changed_) {
      Past& past = forest_.past(root);
      const Index size = forest_.size(root);
      if (forest_.find(root) != root || past.size == size) continue;
      if (size >= std::max<double>(limits_.min_vertices, limits_.growth * past.offered_size)) {
        settle(root, now);
        offer(root, size, now);
      }
      past.size = size;
      past.level = now;
    }
  }

  void meet(Index a, Index b, std::int32_t now) {
    if (a == b) return;
    // The component with the longer past keeps its head; of equals the older.
    const auto age = [&](Index r) {
      return std::tuple(forest_.past(r).size, forest_.past(r).offered_size, forest_.past(r).level);
    };
    if (age(a) < age(b) || (age(a) == age(b) && b < a)) std::swap(a, b);
    if (forest_.past(b).size >= limits_.min_vertices) {  // two components with a past meet: both as they were
      // Before a merger a stage is worth offering for less growth than between mergers.
      const double growth = 1 + (limits_.growth - 1) / 4;
      for (Index head : {a, b}) {
        const Past past = forest_.past(head);
        if (past.size >= growth * past.offered_size) {
          settle(head, past.level);
          offer(head, past.size, past.level);
        }
        settle(head, now);
      }
    }
    forest_.join(a, b);
  }

  void offer(Index head, Index size, std::int32_t at) {
    if (size < limits_.min_vertices || size > limits_.max_vertices) return;
    forest_.past(head).offered_size = size;
    forest_.past(head).offered = static_cast<Index>(offers_.size());
    offers_.push_back({head, size, at});
  }

  /// The last stage offered is judged by how far the field fell until now.
  void settle(Index head, std::int32_t now) {
    if (forest_.past(head).offered == none) return;
    Offer& last = offers_[forest_.past(head).offered];
    if (last.saliency < 0) last.saliency = 1 - std::exp(-step_ * (last.level - now));
  }

  const toposcope::MeshView& mesh_;
  const Levels& level_;
  double step_;
  const Limits& limits_;
  Forest forest_;
  std::vector<Offer> offers_;
  std::vector<Index> changed_;
};

}  // namespace

Components components(const toposcope::MeshView& mesh, const Levels& level, double step, const Limits& limits) {
  Flood flood(mesh, level, step, limits);
  flood.run();
  return flood.best();
}

}  // namespace component_tree
