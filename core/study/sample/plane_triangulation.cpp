// SPDX-License-Identifier: BSD-3-Clause
#include "sample/plane_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace toposcope {

namespace {

/// Twice the area of abc, positive where they turn left.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Whether p lies in the triangle abc, which turns left, or on it.
bool inside(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

class EarClipper {
 public:
  explicit EarClipper(std::span<const Vec2> points) : points_(points) {}

  std::vector<Triangle> clip(std::vector<Index> polygon, std::vector<std::vector<Index>> holes) {
    // From the right to the left: the way to the right of a hole then meets only what is joined already.
    const auto rightmost = [&](const std::vector<Index>& hole) {
      return *std::max_element(hole.begin(), hole.end(),
                               [&](Index a, Index b) { return points_[a].x() < points_[b].x(); });
    };
    std::sort(holes.begin(), holes.end(),
              [&](const auto& a, const auto& b) { return points_[rightmost(a)].x() > points_[rightmost(b)].x(); });
    for (std::vector<Index>& hole : holes) {
      std::rotate(hole.begin(), std::find(hole.begin(), hole.end(), rightmost(hole)), hole.end());
      join(polygon, hole);
    }
    return ears(polygon);
  }

 private:
  const Vec2& at(const std::vector<Index>& polygon, std::size_t i) const {
    return points_[polygon[i % polygon.size()]];
  }

  /// Makes the hole a part of the polygon, by a bridge from its first corner to a corner that sees it.
  void join(std::vector<Index>& polygon, const std::vector<Index>& hole) const {
    const std::size_t corner = visible_from(polygon, points_[hole.front()]);
    std::vector<Index> bridge(hole);
    bridge.push_back(hole.front());
    bridge.push_back(polygon[corner]);
    polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(corner) + 1, bridge.begin(), bridge.end());
  }

  /// A corner of the polygon that sees the point, which lies within it.
  std::size_t visible_from(const std::vector<Index>& polygon, const Vec2& from) const {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t best = polygon.size();
    for (std::size_t i = 0; i < polygon.size();
         ++i) {  // where the ray to the right leaves the polygon: an edge going up
      const Vec2 &a = at(polygon, i), &b = at(polygon, i + 1);
      if (a.y() > from.y() || b.y() < from.y() || a.y() == b.y()) continue;
      const double x = a.x() + (from.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (x < from.x() || x >= nearest) continue;
      nearest = x;
      best = a.x() > b.x() ? i : (i + 1) % polygon.size();
    }
    if (best == polygon.size()) throw std::logic_error("a hole lies outside of its polygon");
    const Vec2 hit(nearest, from.y()), target = at(polygon, best);
    if (target == hit) return best;
    // What is reflex and stands in the way sees it instead, at the least angle to the ray.
    const bool above = target.y() > from.y();
    double least = angle(from, target), least_length = (target - from).norm();
    const std::size_t first = best;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2& p = at(polygon, i);
      if (p == target || p == from) continue;
      if (!(above ? inside(from, hit, target, p) : inside(from, target, hit, p))) continue;
      if (turn(at(polygon, i + polygon.size() - 1), p, at(polygon, i + 1)) >= 0) continue;
      const double tilt = angle(from, p), length = (p - from).norm();
      if (tilt > least || (tilt == least && length >= least_length)) continue;
      least = tilt;
      least_length = length;
      best = i;
    }
    return facing(polygon, best == first ? first : best, from);
  }

  static double angle(const Vec2& from, const Vec2& to) {
    return std::abs(std::atan2(to.y() - from.y(), to.x() - from.x()));
  }

  /// Of the places where a bridge has doubled a corner, the one between whose edges the point lies.
  std::size_t facing(const std::vector<Index>& polygon, std::size_t corner, const Vec2& from) const {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (polygon[i] != polygon[corner]) continue;
      const Vec2 &before = at(polygon, i + polygon.size() - 1), &self = at(polygon, i), &after = at(polygon, i + 1);
      const bool left_of_in = turn(before, self, from) > 0, left_of_out = turn(self, after, from) > 0;
      if (turn(before, self, after) >= 0 ? left_of_in && left_of_out : left_of_in || left_of_out) return i;
    }
    return corner;
  }

  std::vector<Triangle> ears(const std::vector<Index>& polygon) const {
    const std::size_t n = polygon.size();
    std::vector<std::size_t> before(n), after(n);
    for (std::size_t i = 0; i < n; ++i) {
      before[i] = (i + n - 1) % n;
      after[i] = (i + 1) % n;
    }
    const auto reflex_at = [&](std::size_t i) {
      return turn(points_[polygon[before[i]]], points_[polygon[i]], points_[polygon[after[i]]]) <= 0;
    };
    std::vector<char> reflex(n);
    std::vector<std::size_t> reflexes;
    for (std::size_t i = 0; i < n; ++i)
      if ((reflex[i] = reflex_at(i))) reflexes.push_back(i);
    std::vector<char> gone(n, 0);
    const auto is_ear = [&](std::size_t i) {
      if (reflex[i]) return false;
      const Vec2 &a = points_[polygon[before[i]]], &b = points_[polygon[i]], &c = points_[polygon[after[i]]];
      return std::none_of(reflexes.begin(), reflexes.end(), [&](std::size_t r) {
        const Vec2& p = points_[polygon[r]];
        return !gone[r] && reflex[r] && p != a && p != b && p != c && inside(a, b, c, p);
      });
    };
    std::vector<Triangle> triangles;
    std::size_t left = n, i = 0, tried = 0;
    while (left > 3) {
      // Rounding may leave no strict ear: then any corner that turns left will do.
      if (tried > 2 * left) throw std::logic_error("the loops of a face meet: no ear is left to cut");
      if (tried > left ? !reflex[i] : is_ear(i)) {
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
        continue;
      }
      i = after[i];
      ++tried;
    }
    triangles.push_back({polygon[before[i]], polygon[i], polygon[after[i]]});
    return triangles;
  }

  std::span<const Vec2> points_;
};

}  // namespace

std::vector<Triangle> triangulate(std::span<const Vec2> points, const std::vector<Index>& outer,
                                  const std::vector<std::vector<Index>>& holes) {
  return EarClipper(points).clip(outer, holes);
}

}  // namespace toposcope
