// SPDX-License-Identifier: BSD-3-Clause
#include "sample/plane_triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace toposcope {

namespace {

/// On a grid so coarse that turns are exact: loops of CAD are full of corners on one line.
struct GridPoint {
  std::int64_t x, y;
  bool operator==(const GridPoint&) const = default;
};

std::vector<GridPoint> on_grid(std::span<const Vec2> points) {
  double reach = 0;
  for (const Vec2& p : points) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  const double scale = reach > 0 ? std::ldexp(1.0, 28 - std::ilogb(reach)) : 1;  // a power of two keeps what is round
  std::vector<GridPoint> grid;
  for (const Vec2& p : points) grid.push_back({std::llround(p.x() * scale), std::llround(p.y() * scale)});
  return grid;
}

/// Twice the area of abc, positive where they turn left.
std::int64_t turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether p lies in the triangle abc, which turns left, or on it.
bool inside(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& p) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

/// Whether p lies on the segment between a and b, its ends excluded.
bool between(const GridPoint& a, const GridPoint& b, const GridPoint& p) {
  if (turn(a, b, p) != 0 || p == a || p == b) return false;
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool cross(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const auto sign = [](std::int64_t value) { return (value > 0) - (value < 0); };
  return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

using Loop = std::vector<Index>;

class EarClipper {
 public:
  explicit EarClipper(std::span<const Vec2> points) : points_(on_grid(points)) {}

  std::vector<Triangle> clip(Loop polygon, std::vector<Loop> holes) {
    // From the right to the left: what lies to the right of a hole's rightmost corner is joined already.
    const auto left_of = [&](Index a, Index b) { return points_[a].x < points_[b].x; };
    for (Loop& hole : holes) std::rotate(hole.begin(), std::max_element(hole.begin(), hole.end(), left_of), hole.end());
    std::sort(holes.begin(), holes.end(), [&](const Loop& a, const Loop& b) { return left_of(a.front(), b.front()); });
    for (; !holes.empty(); holes.pop_back()) join(polygon, holes);
    return ears(polygon);
  }

 private:
  const GridPoint& at(const Loop& loop, std::size_t i) const { return points_[loop[i % loop.size()]]; }

  /// Makes the last hole a part of the polygon, by a bridge between the nearest corners that see each other.
  void join(Loop& polygon, const std::vector<Loop>& holes) const {
    Loop hole = holes.back();
    const GridPoint& from = points_[hole.front()];
    std::vector<std::pair<std::int64_t, std::size_t>> nearest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::int64_t x = at(polygon, i).x - from.x, y = at(polygon, i).y - from.y;
      nearest.emplace_back(x * x + y * y, i);
    }
    std::sort(nearest.begin(), nearest.end());
    for (const auto& [distance, corner] : nearest) {
      if (!faces(polygon, corner, from)) continue;
      const GridPoint& to = at(polygon, corner);
      if (blocked(polygon, from, to) ||
          std::any_of(holes.begin(), holes.end(), [&](const Loop& loop) { return blocked(loop, from, to); }))
        continue;
      hole.push_back(hole.front());
      hole.push_back(polygon[corner]);
      polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(corner) + 1, hole.begin(), hole.end());
      return;
    }
    throw std::logic_error("the loops of a face meet: no corner sees the hole");
  }

  bool blocked(const Loop& loop, const GridPoint& from, const GridPoint& to) const {
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (between(from, to, at(loop, i)) || cross(from, to, at(loop, i), at(loop, i + 1))) return true;
    return false;
  }

  /// Whether a point lies between the edges of a corner, which a bridge may have doubled.
  bool faces(const Loop& polygon, std::size_t i, const GridPoint& p) const {
    const GridPoint &before = at(polygon, i + polygon.size() - 1), &self = at(polygon, i), &after = at(polygon, i + 1);
    const bool left_of_in = turn(before, self, p) > 0, left_of_out = turn(self, after, p) > 0;
    return turn(before, self, after) >= 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  }

  std::vector<Triangle> ears(const Loop& polygon) const {
    const std::size_t n = polygon.size();
    std::vector<std::size_t> before(n), after(n);
    for (std::size_t i = 0; i < n; ++i) {
      before[i] = (i + n - 1) % n;
      after[i] = (i + 1) % n;
    }
    const auto point = [&](std::size_t i) -> const GridPoint& { return points_[polygon[i]]; };
    const auto reflex_at = [&](std::size_t i) { return turn(point(before[i]), point(i), point(after[i])) <= 0; };
    std::vector<char> reflex(n), gone(n, 0);
    std::vector<std::size_t> reflexes;
    for (std::size_t i = 0; i < n; ++i)
      if ((reflex[i] = reflex_at(i))) reflexes.push_back(i);
    const std::vector<std::size_t> doubled = doubled_in(polygon);
    // A corner that a bridge has doubled may turn left at each of its places, and yet stand in the way: it lies in the
    // triangle, or an edge goes from it into the triangle or along the side that the cut would make.
    const auto enters = [&](std::size_t i, std::size_t other) {
      const GridPoint &a = point(before[i]), &b = point(i), &c = point(after[i]), &p = point(other);
      if (p != a && p != b && p != c) return inside(a, b, c, p);
      for (const std::size_t k : {before[other], after[other]}) {
        const GridPoint& q = point(k);
        if (p == a && q != a && turn(a, b, q) > 0 && turn(c, a, q) >= 0) return true;
        if (p == b && q != b && turn(a, b, q) > 0 && turn(b, c, q) > 0) return true;
        if (p == c && q != c && turn(b, c, q) > 0 && turn(c, a, q) >= 0) return true;
      }
      return false;
    };
    const auto is_ear = [&](std::size_t i) {
      if (reflex[i]) return false;
      const GridPoint &a = point(before[i]), &b = point(i), &c = point(after[i]);
      if (std::any_of(reflexes.begin(), reflexes.end(), [&](std::size_t r) {
            const GridPoint& p = point(r);
            return !gone[r] && reflex[r] && p != a && p != b && p != c && inside(a, b, c, p);
          }))
        return false;
      return std::none_of(doubled.begin(), doubled.end(), [&](std::size_t d) {
        return !gone[d] && d != i && d != before[i] && d != after[i] && enters(i, d);
      });
    };
    std::vector<Triangle> triangles;
    std::size_t left = n, i = 0, tried = 0;
    while (left > 3) {
      if (tried > left) throw std::logic_error("the loops of a face meet: no ear is left to cut");
      if (!is_ear(i)) {
        i = after[i];
        ++tried;
        continue;
      }
      triangles.push_back({polygon[before[i]], polygon[i], polygon[after[i]]});
      gone[i] = 1;
      after[before[i]] = after[i];
      before[after[i]] = before[i];
      for (const std::size_t k : {before[i], after[i]}) {
        const bool was = reflex[k];
        reflex[k] = reflex_at(k);
        if (!was && reflex[k]) reflexes.push_back(k);
      }
      --left;
      tried = 0;
      i = after[after[i]];  // leave the neighbour, so that no fan of slivers arises
    }
    triangles.push_back({polygon[before[i]], polygon[i], polygon[after[i]]});
    return triangles;
  }

  static std::vector<std::size_t> doubled_in(const Loop& polygon) {
    Loop sorted = polygon;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::size_t> doubled;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), polygon[i]);
      if (last - first > 1) doubled.push_back(i);
    }
    return doubled;
  }

  std::vector<GridPoint> points_;
};

}  // namespace

std::vector<Triangle> triangulate(std::span<const Vec2> points, const std::vector<Index>& outer,
                                  const std::vector<std::vector<Index>>& holes) {
  return EarClipper(points).clip(outer, holes);
}

}  // namespace toposcope
