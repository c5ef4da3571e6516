// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sample/depth_view.h"

namespace toposcope {

using Floats = Eigen::ArrayXf;

/// Points about the origin, coordinate by coordinate.
struct PointBatch {
  Floats x, y, z;
  explicit PointBatch(Eigen::Index most) : x(most), y(most), z(most) {}
  void set(Eigen::Index i, const Vec3& p) {
    x[i] = static_cast<float>(p.x());
    y[i] = static_cast<float>(p.y());
    z[i] = static_cast<float>(p.z());
  }
};

/// What cells of a depth image have in common: greatest and least inverse depth, and the least distance of a tangent
/// plane from the viewpoint.
struct DepthRange {
  float nearest = 0, farthest = 1e30F, plane = 1e30F;

  void add(const DepthCell& cell) {
    const float beside = cell.w + cell.wx, below = cell.w + cell.wy, across = beside + cell.wy + cell.wxy;
    nearest = std::max(nearest, std::max(std::max(cell.w, beside), std::max(below, across)));
    farthest = std::min(farthest, std::min(std::min(cell.w, beside), std::min(below, across)));
    plane = std::min(plane, cell.plane);
  }
  void add(const DepthRange& other) {
    nearest = std::max(nearest, other.nearest);
    farthest = std::min(farthest, other.farthest);
    plane = std::min(plane, other.plane);
  }
  /// Whether all that lies at depths up to `depth` is in front of the planes by more than `distance`; or all from
  /// `depth` on behind them.
  bool in_front(float depth, float distance) const { return (1 - depth * nearest) * plane > distance; }
  bool behind(float depth, float distance) const { return (depth * farthest - 1) * plane > distance; }
};

/// Of 4 by 4 cells.
struct Tile {
  DepthRange all, measured;
};

/// A view's camera in single precision.
class DepthLookup {
 public:
  /// Where points come to lie in the image.
  struct Scratch {
    Floats depth, scale, column, row;
    explicit Scratch(Eigen::Index most) : depth(most), scale(most), column(most), row(most) {}
  };

  explicit DepthLookup(const DepthView& view);

  /// What the view says of a ball: that it saw through all of it, that all of it lies deep behind what it saw, that
  /// both occur but no surface is near, or that one may be.
  enum class Verdict { free, hidden, mixed, near };
  Verdict judge(const Eigen::Vector3f& center, float radius, float front, float behind) const;

  /// Calls take(i, distance, weight) for each point: the distance to the plane seen there, positive in front of it, and
  /// the measurement's weight.
  template <class Take>
  void look(const PointBatch& points, Eigen::Index count, Scratch& scratch, Take take) const {
    const auto x = points.x.head(count), y = points.y.head(count), z = points.z.head(count);
    auto depth = scratch.depth.head(count), scale = scratch.scale.head(count);
    auto columns = scratch.column.head(count), rows = scratch.row.head(count);
    depth = axes_(2, 0) * x + axes_(2, 1) * y + axes_(2, 2) * z + offset_.z();
    scale = focal_ / depth;
    columns = (axes_(0, 0) * x + axes_(0, 1) * y + axes_(0, 2) * z + offset_.x()) * scale + center_x_;
    columns = columns.max(0.0F).min(last_x_);
    rows = (axes_(1, 0) * x + axes_(1, 1) * y + axes_(1, 2) * z + offset_.y()) * scale + center_y_;
    rows = rows.max(0.0F).min(last_y_);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto column = static_cast<std::int32_t>(columns[i]), row = static_cast<std::int32_t>(rows[i]);
      const DepthCell& cell = cells_[static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column)];
      const float fx = columns[i] - static_cast<float>(column), fy = rows[i] - static_cast<float>(row);
      const float w = cell.w + fx * cell.wx + fy * (cell.wy + fx * cell.wxy);
      take(static_cast<std::size_t>(i), (1 - depth[i] * w) * cell.plane, cell.weight);
    }
  }

 private:
  Eigen::Matrix3f axes_;
  Eigen::Vector3f offset_;
  float focal_, center_x_, center_y_, last_x_, last_y_;
  std::uint32_t width_;
  const DepthCell* cells_;
  std::uint32_t tiles_wide_;
  std::vector<Tile> tiles_;
};

std::vector<DepthLookup> lookups_of(std::span<const DepthView> views, Context& context);

}  // namespace toposcope
