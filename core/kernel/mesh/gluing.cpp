// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/gluing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "toposcope/geometry/large_array.h"
#include "toposcope/geometry/lines.h"

namespace toposcope {
namespace {

/// A side at its edge, from the lesser to the greater vertex.
struct Side {
  Index high;  ///< the greater vertex
  Index side;
};

/// Glues the sides of one edge.
class Edge {
 public:
  Edge(std::span<const Vec3> positions, std::span<const Triangle> welded, std::span<const Triangle> original,
       Gluing& gluing)
      : positions_(positions), welded_(welded), original_(original), gluing_(gluing) {}

  void glue(std::span<const Side> sides) {
    if (sides.size() == 1) return;
    if (sides.size() == 2) return join(sides[0].side, sides[1].side);
    ++gluing_.split_edges;
    rest_.clear();
    for (const Side& s : sides) rest_.push_back(s.side);
    join_by_original();
    if (rest_.size() > 2) join_by_angle();
    if (rest_.size() == 2) join(rest_[0], rest_[1]);
  }

 private:
  void join(Index a, Index b) {
    gluing_.opposite[a] = b;
    gluing_.opposite[b] = a;
  }

  Index start(Index side) const { return welded_[side / 3][side % 3]; }
  Index end(Index side) const { return start(Gluing::next(side)); }
  std::pair<Index, Index> original_edge(Index side) const {
    const Index a = original_[side / 3][side % 3], b = original_[side / 3][Gluing::next(side) % 3];
    return std::minmax(a, b);
  }

  void join_by_original() {
    std::sort(rest_.begin(), rest_.end(),
              [&](Index a, Index b) { return std::pair(original_edge(a), a) < std::pair(original_edge(b), b); });
    if (original_edge(rest_.front()) == original_edge(rest_.back())) return;
    std::size_t kept = 0;
    for (std::size_t begin = 0, end = 0; begin < rest_.size(); begin = end) {
      while (end < rest_.size() && original_edge(rest_[end]) == original_edge(rest_[begin])) ++end;
      if (end - begin == 2)
        join(rest_[begin], rest_[begin + 1]);
      else
        while (begin < end) rest_[kept++] = rest_[begin++];
    }
    rest_.resize(kept);
  }

  /// A face that runs up the edge has its material behind it, seen counter-clockwise, one that runs down before it: a
  /// face that runs down and the next one that runs up bound the same material, as brackets do.
  void join_by_angle() {
    // Up by position, so that the order of the vertices does not matter.
    Index low = start(rest_[0]), high = end(rest_[0]);
    if (std::ranges::lexicographical_compare(positions_[high], positions_[low])) std::swap(low, high);
    const Vec3 axis = (positions_[high] - positions_[low]).stableNormalized();
    const Vec3 u = any_perpendicular(axis), v = axis.cross(u);
    around_.clear();
    for (Index side : rest_) {
      const Vec3 apex = positions_[start(Gluing::last(side))] - positions_[low];
      around_.push_back({std::atan2(apex.dot(v), apex.dot(u)), side});
    }
    std::sort(around_.begin(), around_.end());
    open_.clear();
    std::vector<bool> joined(around_.size(), false);
    // Twice around: a bracket that opens before the start of the circle closes after it.
    for (std::size_t i = 0; i < 2 * around_.size(); ++i) {
      const std::size_t at = i % around_.size();
      const Index side = around_[at].second;
      const bool runs_up = start(side) == low;
      if (joined[at]) continue;
      if (!runs_up) {
        if (i < around_.size()) open_.push_back(at);
      } else if (!open_.empty()) {
        join(around_[open_.back()].second, side);
        joined[at] = joined[open_.back()] = true;
        open_.pop_back();
      }
    }
    rest_.clear();
    for (std::size_t i = 0; i < around_.size(); ++i)
      if (!joined[i]) rest_.push_back(around_[i].second);
  }

  std::span<const Vec3> positions_;
  std::span<const Triangle> welded_, original_;
  Gluing& gluing_;
  std::vector<Index> rest_;
  std::vector<std::pair<double, Index>> around_;
  std::vector<std::size_t> open_;
};

}  // namespace

Gluing glue(std::span<const Vec3> positions, std::span<const Triangle> welded, std::span<const Triangle> original) {
  Gluing gluing;
  gluing.opposite = large_array<Index>(3 * welded.size(), Gluing::none);
  // Sides in rows by the lesser vertex of their edge, by counting; within a row by the greater one.
  std::vector<Index> offsets = large_array<Index>(positions.size() + 1);
  const auto for_each_side = [&](const auto& body) {
    for (Index f = 0; f < welded.size(); ++f)
      for (Index k = 0; k < 3; ++k) {
        const Index a = welded[f][k], b = welded[f][k == 2 ? 0 : k + 1];
        body(std::min(a, b), Side{std::max(a, b), 3 * f + k});
      }
  };
  for_each_side([&](Index low, const Side&) { ++offsets[low + 1]; });
  for (std::size_t v = 1; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
  std::vector<Side> sides = large_array<Side>(3 * welded.size());
  std::vector<Index> place = offsets;
  for_each_side([&](Index low, const Side& side) { sides[place[low]++] = side; });

  Edge edge(positions, welded, original, gluing);
  for (std::size_t v = 0; v + 1 < offsets.size(); ++v) {
    const auto row = std::span(sides).subspan(offsets[v], offsets[v + 1] - offsets[v]);
    std::sort(row.begin(), row.end(),
              [](const Side& a, const Side& b) { return std::pair(a.high, a.side) < std::pair(b.high, b.side); });
    for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
      while (end < row.size() && row[end].high == row[begin].high) ++end;
      edge.glue(row.subspan(begin, end - begin));
    }
  }
  return gluing;
}

}  // namespace toposcope
