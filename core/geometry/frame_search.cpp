// SPDX-License-Identifier: BSD-3-Clause
#include "frame_search.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "convex_hull.h"
#include "toposcope/geometry/lines.h"

namespace toposcope::geometry {
namespace {

constexpr double gain = 1e-10;        ///< of volume, relative: less is rounding
constexpr int most_steps = 24;        ///< of a descent: in some valleys each gains less than the one before
constexpr double worthy_gain = 1e-4;  ///< of volume, relative: what makes a tilt worth trying again

}  // namespace

Columns::Columns(std::span<const Vec3> points)
    : x_(points.size()), y_(points.size()), z_(points.size()), projection_(points.size()) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    x_[i] = points[i].x();
    y_[i] = points[i].y();
    z_[i] = points[i].z();
  }
}

const Eigen::ArrayXd& Columns::project(const Vec3& axis) {
  projection_ = x_ * axis.x() + y_ * axis.y() + z_ * axis.z();
  return projection_;
}

double Columns::width(const Vec3& axis) {
  project(axis);
  return projection_.maxCoeff() - projection_.minCoeff();
}

FrameSearch::FrameSearch(std::span<const Vec3> points, const Vec3& half_extents) : columns_({}), area_columns_({}) {
  std::vector<Vec3> normalized;
  for (const Vec3& p : points) normalized.push_back(p.cwiseQuotient(half_extents));
  std::vector<Triangle> hull = convex_hull(normalized);
  constexpr Index unplaced = std::numeric_limits<Index>::max();
  std::vector<Index> place(points.size(), unplaced);
  for (Triangle& t : hull)
    for (Index& v : t) {
      if (place[v] == unplaced) {
        place[v] = static_cast<Index>(corners_.size());
        corners_.push_back(points[v]);
      }
      v = place[v];
    }
  for (const auto& [a, b, c] : hull) areas_.push_back((corners_[b] - corners_[a]).cross(corners_[c] - corners_[a]) / 2);
  build_edges(hull);
  columns_ = Columns(corners_);
  area_columns_ = Columns(areas_);
}

void FrameSearch::build_edges(const std::vector<Triangle>& hull) {
  std::vector<std::array<Index, 4>> halves;  // lower corner, higher corner, runs downwards, face
  for (Index f = 0; f < hull.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const Index from = hull[f][i], to = hull[f][(i + 1) % 3];
      halves.push_back({std::min(from, to), std::max(from, to), from > to, f});
    }
  std::sort(halves.begin(), halves.end());
  for (std::size_t i = 0; i + 1 < halves.size(); i += 2)
    edges_.push_back({halves[i][0], halves[i][1], halves[i][3], halves[i + 1][3]});
}

Candidate FrameSearch::best_about(const Vec3& axis) {
  const Eigen::ArrayXd& facing = area_columns_.project(axis);
  const Vec3 u = any_perpendicular(axis), v = axis.cross(u);
  shadow_.clear();
  sides_.clear();
  for (const Edge& e : edges_) {
    if ((facing[e.left] > 0) == (facing[e.right] > 0)) continue;
    const Vec3& from = corners_[facing[e.left] > 0 ? e.from : e.to];
    const Vec3 along = corners_[facing[e.left] > 0 ? e.to : e.from] - from;
    shadow_.emplace_back(u.dot(from), v.dot(from));
    const Eigen::Vector2d side(u.dot(along), v.dot(along));
    if (side.squaredNorm() > 0) sides_.push_back(side);  // an edge along the axis has no direction here
  }
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector2d best(1, 0);
  for (const Eigen::Vector2d& side : sides_) {
    const Eigen::Vector2d along = side.normalized(), across(-along.y(), along.x());
    const Eigen::Array2d of_x(along.x(), across.x()), of_y(along.y(), across.y());
    Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Eigen::Vector2d& p : shadow_) {
      const Eigen::Array2d q = of_x * p.x() + of_y * p.y();
      low = low.min(q);
      high = high.max(q);
    }
    const double area = (high - low).prod();
    if (area < least) {
      least = area;
      best = along;
    }
  }
  return {{best.x() * u + best.y() * v, best.x() * v - best.y() * u, axis}, least * width(axis)};
}

std::vector<Candidate> FrameSearch::flush_with_faces(std::size_t enough, std::size_t most) {
  std::vector<Candidate> candidates;
  for (int i = 0; i < 3; ++i) candidates.push_back(best_about(Vec3::Unit(i)));
  // Width times the area of the shadow is a lower bound of the volume of any box with an axis along the normal.
  std::vector<std::pair<double, Vec3>> normals;
  for (const Vec3& area : areas_) {
    const double size = area.norm();
    if (!(size > 0)) continue;
    const Vec3 normal = area / size;
    normals.emplace_back(area_columns_.project(normal).abs().sum() / 2 * width(normal), normal);
  }
  const auto by_bound = [](const auto& p, const auto& q) { return p.first < q.first; };
  std::stable_sort(normals.begin(), normals.end(), by_bound);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [bound, normal] : normals) {
    if (candidates.size() >= most || (bound >= least && candidates.size() >= enough)) break;
    candidates.push_back(best_about(normal));
    least = std::min(least, candidates.back().volume);
  }
  const auto by_volume = [](const Candidate& p, const Candidate& q) { return p.volume < q.volume; };
  std::stable_sort(candidates.begin(), candidates.end(), by_volume);
  return candidates;
}

Candidate FrameSearch::descend(Candidate current) {
  for (int step = 0; step < most_steps; ++step) {
    Candidate best = current;
    for (const Vec3& axis : current.axes)
      if (const Candidate next = best_about(axis); next.volume < best.volume) best = next;
    if (best.volume >= current.volume * (1 - gain)) break;
    current = best;
  }
  return current;
}

Candidate FrameSearch::polish(Candidate current, double first, double last) {
  for (double angle = first; angle >= last;) {
    Candidate best = current;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &axis = current.axes[k], &u = current.axes[(k + 1) % 3], &v = current.axes[(k + 2) % 3];
      for (const Vec3& tilt : {Vec3(u + v), Vec3(u - v), Vec3(v - u), Vec3(-u - v)}) {
        const Candidate next = best_about((axis + angle * tilt).normalized());
        if (next.volume < best.volume) best = next;
      }
    }
    if (best.volume >= current.volume * (1 - worthy_gain)) angle /= 2;
    if (best.volume < current.volume * (1 - gain)) current = descend(best);
  }
  return current;
}

}  // namespace toposcope::geometry
