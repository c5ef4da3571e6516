// SPDX-License-Identifier: BSD-3-Clause
#include "blocked_points.h"

#include <algorithm>

namespace toposcope::geometry {
namespace {

constexpr std::size_t block_size = 256;

}  // namespace

BlockedPoints::BlockedPoints(std::vector<Vec3> points) : points_(std::move(points)) {
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
  std::size_t best = 0;
  double best_along = along(points_[0]);
  const auto search = [&](std::size_t b) {
    const std::size_t end = std::min((b + 1) * block_size, points_.size());
    for (std::size_t i = b * block_size; i < end; ++i)
      if (const double a = along(points_[i]); a > best_along || (a == best_along && i < best)) {
        best = i;
        best_along = a;
      }
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
