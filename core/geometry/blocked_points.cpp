// SPDX-License-Identifier: BSD-3-Clause
#include "blocked_points.h"

#include <algorithm>

namespace toposcope::geometry {
namespace {

constexpr std::size_t block_size = 64;

}  // namespace

BlockedPoints::BlockedPoints(std::vector<Vec3> points)
    : points_(std::move(points)), x_(points_.size()), y_(points_.size()), z_(points_.size()) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    x_[at] = points_[i].x();
    y_[at] = points_[i].y();
    z_[at] = points_[i].z();
  }
  blocks_.reserve(points_.size() / block_size + 1);
  for (std::size_t begin = 0; begin < points_.size(); begin += block_size) {
    Block block{points_[begin], points_[begin]};
    const std::size_t end = std::min(begin + block_size, points_.size());
    for (std::size_t i = begin + 1; i < end; ++i) {
      block.low = block.low.cwiseMin(points_[i]);
      block.high = block.high.cwiseMax(points_[i]);
    }
    blocks_.push_back(block);
  }
}

Index BlockedPoints::farthest(const Vec3& axis) const {
  const auto along = [&](const Vec3& p) { return p.x() * axis.x() + p.y() * axis.y() + p.z() * axis.z(); };
  // Summed in the same order as a point's own coordinate, so that rounding cannot put a point beyond its block's bound.
  const auto bound = [&](const Block& block) {
    return along({axis.x() > 0 ? block.high.x() : block.low.x(), axis.y() > 0 ? block.high.y() : block.low.y(),
                  axis.z() > 0 ? block.high.z() : block.low.z()});
  };
  Eigen::Array<double, Eigen::Dynamic, 1, 0, block_size, 1> places;
  std::size_t best = 0;
  double best_along = along(points_[0]);
  const auto search = [&](std::size_t b) {
    const std::size_t first = b * block_size, count = std::min(block_size, points_.size() - first);
    const auto part = [&](const Eigen::ArrayXd& all) {
      return all.segment(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
    };
    places = part(x_) * axis.x() + part(y_) * axis.y() + part(z_) * axis.z();
    const double most = places.maxCoeff();
    if (!(most > best_along || (most == best_along && first < best))) return;
    const auto* const at = std::find(places.data(), places.data() + count, most);
    best = first + static_cast<std::size_t>(at - places.data());
    best_along = most;
  };
  std::size_t promising = 0;
  double best_bound = bound(blocks_[0]);
  for (std::size_t b = 1; b < blocks_.size(); ++b)
    if (const double reach = bound(blocks_[b]); reach > best_bound) {
      promising = b;
      best_bound = reach;
    }
  search(promising);
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    if (b != promising && bound(blocks_[b]) >= best_along) search(b);
  return static_cast<Index>(best);
}

}  // namespace toposcope::geometry
