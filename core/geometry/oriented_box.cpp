// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "blocked_points.h"
#include "convex_hull.h"
#include "frame_search.h"
#include "toposcope/geometry/large_array.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

using geometry::Axes, geometry::BlockedPoints, geometry::Candidate, geometry::FrameSearch;

constexpr std::size_t few_points = 100, most_points = 1024;  ///< of which the whole hull is made: always, at most
constexpr std::size_t most_extremes = 75;  ///< of the points farthest out, above which only these make the hull
constexpr std::size_t most_corners = 128;  ///< of the whole hull
constexpr std::size_t enough_candidates = 16, most_candidates = 24;  ///< frames flush with a face of the hull
constexpr std::size_t descended_corners = 150;  ///< corners of the hull times frames that are improved
constexpr std::size_t polished_corners = 30;    ///< corners of the hull times frames that are improved further
constexpr double largest_tilt = 0.12, smallest_tilt = 0.01;  ///< radians
constexpr int most_rounds = 4;                               ///< of adding what lies outside of the box
constexpr double same_volume = 1e-9;                         ///< relative difference of volumes of one and the same box
constexpr double rounding = 1e-13;                           ///< of lengths, relative to the set's extent
constexpr double flat_side = 1e-12;                          ///< side / longest side that is rounding, not thickness

const Axes unit_axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};

struct Side {
  double length, middle;
  Vec3 axis;
};

/// Two points for each of 49 directions spread over the sphere: those farthest out. The directions are those of a set
/// scaled to a cube, and have all symmetries of the cube, since the signs of principal axes mean nothing.
std::vector<Vec3> extreme_points(const BlockedPoints& points, const Vec3& half_extents) {
  std::vector<Index> extremes;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k) {
        const bool first_of_pair = i > 0 || (i == 0 && (j > 0 || (j == 0 && k > 0)));
        if (!first_of_pair || std::gcd(std::gcd(i, j), k) != 1) continue;
        const Vec3 axis = Vec3(i, j, k).cwiseQuotient(half_extents);
        extremes.push_back(points.farthest(-axis));
        extremes.push_back(points.farthest(axis));
      }
  std::sort(extremes.begin(), extremes.end());
  extremes.erase(std::unique(extremes.begin(), extremes.end()), extremes.end());
  std::vector<Vec3> result;
  for (Index i : extremes) result.push_back(points.points()[i]);
  return result;
}

Candidate best_frame(FrameSearch& search) {
  // A polyhedron of few corners has few but deep local minima, one of many corners has many shallow ones.
  const std::size_t corners = search.corners().size();
  std::vector<Candidate> candidates = search.flush_with_faces(enough_candidates, most_candidates);
  candidates.resize(std::min(candidates.size(), std::clamp<std::size_t>(descended_corners / corners, 2, 16)));
  for (Candidate& candidate : candidates) candidate = search.descend(candidate);
  const auto by_volume = [](const Candidate& p, const Candidate& q) { return p.volume < q.volume; };
  std::stable_sort(candidates.begin(), candidates.end(), by_volume);
  // Many descents end in the same valley.
  const auto same = [](const Candidate& p, const Candidate& q) { return q.volume <= p.volume * (1 + same_volume); };
  candidates.erase(std::unique(candidates.begin(), candidates.end(), same), candidates.end());
  candidates.resize(std::min(candidates.size(), std::clamp<std::size_t>(polished_corners / corners, 1, 16)));
  for (Candidate& candidate : candidates) candidate = search.polish(candidate, largest_tilt, smallest_tilt);
  return *std::min_element(candidates.begin(), candidates.end(), by_volume);
}

/// Frame of the least box around points in space: searched for the hull of some extreme points, which are joined by
/// the points found farthest outside of the box, or of one tilted a little, until there are none.
Axes search_axes(const BlockedPoints& blocked, const Vec3& half_extents) {
  const std::span<const Vec3> points = blocked.points();
  std::vector<Vec3> extremes;
  if (points.size() > few_points) extremes = extreme_points(blocked, half_extents);
  // Where many directions share an extreme point the hull has few corners: then it is affordable to have them all.
  const bool whole = points.size() <= few_points || (points.size() <= most_points && extremes.size() <= most_extremes);
  FrameSearch search(whole ? points : std::span<const Vec3>(extremes), half_extents);
  if (search.corners().size() > most_corners && !extremes.empty()) search = FrameSearch(extremes, half_extents);
  if (search.corners().empty()) return unit_axes;  // flat to rounding, though its thickness is not nothing
  Candidate best = best_frame(search);
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Vec3> grown(search.corners().begin(), search.corners().end());
    const auto look_along = [&](const Vec3& axis) {
      const Index low = blocked.farthest(-axis), high = blocked.farthest(axis);
      if (axis.dot(points[high] - points[low]) <= search.width(axis) + rounding * half_extents.maxCoeff()) return;
      grown.push_back(points[low]);
      grown.push_back(points[high]);
    };
    for (const Vec3& axis : best.axes) look_along(axis);
    if (grown.size() == search.corners().size()) break;
    const double tilt = largest_tilt / (1 << (2 * round));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (i != j)
          for (double t : {-tilt, tilt}) look_along((best.axes[i] + t * best.axes[j]).normalized());
    FrameSearch next(grown, half_extents);
    if (next.corners().empty()) break;
    search = std::move(next);
    best = search.descend({best.axes, search.volume(best.axes)});
    if (round == 0) best = search.polish(best, largest_tilt / 4, smallest_tilt);
  }
  return best.axes;
}

}  // namespace

Box oriented_box(std::span<const Vec3> points) {
  Box box;
  if (points.empty()) return box;
  const geometry::PrincipalFrame frame = geometry::principal_frame(points);
  std::vector<Vec3> local;  // in the principal frame
  reserve_large(local, points.size());
  for (const Vec3& p : points) {
    const Vec3 d = p - frame.center;
    local.emplace_back(frame.axes[0].dot(d), frame.axes[1].dot(d), frame.axes[2].dot(d));
  }
  const BlockedPoints blocked(std::move(local));
  Axes axes = unit_axes;
  if (frame.dimension == 3) axes = search_axes(blocked, frame.half);
  if (frame.dimension == 2) {
    std::vector<Eigen::Vector2d> flat;
    flat.reserve(points.size());
    for (const Vec3& p : blocked.points()) flat.push_back(p.head<2>());
    const Eigen::Vector2d along = geometry::least_rectangle(flat);
    axes = {Vec3(along.x(), along.y(), 0), Vec3(-along.y(), along.x(), 0), Vec3::UnitZ()};
  }

  std::array<Side, 3> sides;
  for (int i = 0; i < 3; ++i) {
    const double low = axes[i].dot(blocked.points()[blocked.farthest(-axes[i])]);
    const double high = axes[i].dot(blocked.points()[blocked.farthest(axes[i])]);
    sides[i] = {high - low, (low + high) / 2, axes[i]};
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) { return p.length > q.length; });
  const auto outward = [&](const Vec3& v) {
    return Vec3(frame.axes[0] * v[0] + frame.axes[1] * v[1] + frame.axes[2] * v[2]);
  };
  box.center = frame.center;
  for (int i = 0; i < 3; ++i) {
    box.center += outward(sides[i].middle * sides[i].axis);
    box.axes[i] = outward(sides[i].axis);
    box.sides[i] = i < frame.dimension || sides[i].length > flat_side * sides[0].length ? sides[i].length : 0;
  }
  box.axes[2] = box.axes[0].cross(box.axes[1]);
  return box;
}

double enclosing_diameter(std::span<const Box> boxes) {
  Vec3 middle = Vec3::Zero();
  for (const Box& box : boxes) middle += box.center / static_cast<double>(boxes.size());
  double radius = 0;
  for (const Box& box : boxes) radius = std::max(radius, (box.center - middle).norm() + box.diagonal() / 2);
  return 2 * radius;
}

}  // namespace toposcope
