// SPDX-License-Identifier: BSD-3-Clause
#include "io/cut_polygons.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace toposcope {
namespace {

using Vec2 = Eigen::Vector2d;

/// How well a quad is cut into the triangles abc and acd: negative where one of them is folded over (the quad is
/// concave at b or d), and higher for a shorter cut.
double quality_of_cut(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 first = (b - a).cross(c - a), second = (c - a).cross(d - a);
  const double cut = (c - a).squaredNorm();
  return first.dot(second) < 0 ? -1 : 1 / (1 + cut / ((b - d).squaredNorm() + std::numeric_limits<double>::min()));
}

/// The fan cuts quads from their first corner, whichever that is; take the other cut where it is clearly better.
void cut_quad(const std::vector<Vec3>& p, Triangle* fan) {
  constexpr double clearly = 1.001;  // a square keeps the cut of the fan, whatever its rounding
  const auto [a, b, c] = fan[0];
  const Index d = fan[1][2];
  const double as_is = quality_of_cut(p[a], p[b], p[c], p[d]), other = quality_of_cut(p[b], p[c], p[d], p[a]);
  if (other <= (as_is < 0 ? as_is : as_is * clearly)) return;
  fan[0] = {b, c, d};
  fan[1] = {b, d, a};
}

/// Twice the area of abc, positive where they turn left.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

class EarCutter {
 public:
  explicit EarCutter(const TriangleSoup& soup) : positions_(soup.positions), tests_left_(free_tests) {}

  /// \param fan  the triangles of one polygon, replaced
  void cut(std::span<Triangle> fan) {
    if (!flatten(fan)) return;
    tests_left_ += tests_per_corner * static_cast<std::int64_t>(fan.size());
    auto left = static_cast<Index>(corners_.size());
    Index at = 0, since_ear = 0;
    for (Triangle& triangle : fan) {
      // Where no ear is left (the outline crosses itself, or its corners coincide) any corner goes.
      while (tests_left_ > 0 && since_ear < left && !is_ear(at)) {
        at = next_[at];
        ++since_ear;
      }
      triangle = {corners_[previous_[at]], corners_[at], corners_[next_[at]]};
      next_[previous_[at]] = next_[at];
      previous_[next_[at]] = previous_[at];
      --left;
      since_ear = 0;
      at = next_[next_[at]];  // not the neighbour: ears all around rather than one fan
    }
  }

 private:
  /// An outline with thousands of inward corners would cost their square: beyond this many tests the rest is cut
  /// blindly.
  static constexpr std::int64_t free_tests = 1 << 25, tests_per_corner = 64;

  /// The polygon in the plane that its corners span (Newell's normal), turning left. False where it spans none.
  bool flatten(std::span<const Triangle> fan) {
    corners_.assign({fan[0][0], fan[0][1]});
    for (const Triangle& t : fan) corners_.push_back(t[2]);
    const auto count = static_cast<Index>(corners_.size());
    const Vec3 origin = positions_[corners_[0]];
    Vec3 normal = Vec3::Zero();
    for (Index i = 1; i + 1 < count; ++i)
      normal += (positions_[corners_[i]] - origin).cross(positions_[corners_[i + 1]] - origin);
    normal.stableNormalize();
    if (!(normal.squaredNorm() > 0)) return false;
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    flat_.resize(count);
    next_.resize(count);
    previous_.resize(count);
    inward_.clear();
    for (Index i = 0; i < count; ++i) {
      const Vec3 p = positions_[corners_[i]] - origin;
      flat_[i] = {p.dot(u), p.dot(v)};
      next_[i] = i + 1 < count ? i + 1 : 0;
      previous_[i] = i > 0 ? i - 1 : count - 1;
    }
    for (Index i = 0; i < count; ++i)
      if (turn_at(i) <= 0) inward_.push_back(i);
    return true;
  }

  double turn_at(Index i) const { return turn(flat_[previous_[i]], flat_[i], flat_[next_[i]]); }

  /// Turns outward, and no corner that turns inward (the only ones that can be first within) lies in its triangle.
  bool is_ear(Index i) {
    if (!(turn_at(i) > 0)) return false;
    const Vec2 &a = flat_[previous_[i]], &b = flat_[i], &c = flat_[next_[i]];
    tests_left_ -= static_cast<std::int64_t>(inward_.size());
    return std::none_of(inward_.begin(), inward_.end(), [&](Index k) {
      const Vec2& p = flat_[k];
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  const std::vector<Vec3>& positions_;
  std::int64_t tests_left_;
  std::vector<Index> corners_, next_, previous_, inward_;
  std::vector<Vec2> flat_;
};

}  // namespace

void cut_polygons(TriangleSoup& soup) {
  EarCutter ears(soup);
  const auto& origin = soup.face_origin;
  for (std::size_t first = 0, last = 0; first < origin.size(); first = last) {
    while (last < origin.size() && origin[last] == origin[first]) ++last;
    if (last - first == 2) cut_quad(soup.positions, &soup.triangles[first]);
    if (last - first > 2) ears.cut({&soup.triangles[first], last - first});
  }
}

}  // namespace toposcope
