// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope::geometry {

/// Points in blocks of consecutive ones, each with its box: the farthest point along an axis is found without looking
/// at most of them, since neighbours in a mesh's numbering are mostly neighbours in space.
class BlockedPoints {
 public:
  explicit BlockedPoints(std::vector<Vec3> points);

  std::span<const Vec3> points() const { return points_; }
  /// Of the points farthest along an axis the first. \pre not empty
  Index farthest(const Vec3& axis) const;

 private:
  struct Block {
    Vec3 low, high;
  };
  std::vector<Vec3> points_;
  Eigen::ArrayXd x_, y_, z_;  // once more, apart, so that a block's places along an axis are few vector operations
  std::vector<Block> blocks_;
};

}  // namespace toposcope::geometry
