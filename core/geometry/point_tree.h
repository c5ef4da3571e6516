// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanoflann.hpp>
#include <span>

#include "toposcope/types.h"

namespace toposcope::geometry {

/// Points as nanoflann reads them.
struct PointCloud {
  std::span<const Vec3> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index][static_cast<Eigen::Index>(axis)];
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

/// A k-d tree of a cloud, which it refers to.
struct PointTree : nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud, double, Index>,
                                                       PointCloud, 3, Index> {
  explicit PointTree(const PointCloud& cloud)
      : KDTreeSingleIndexAdaptor(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_points)) {}
  static constexpr std::size_t leaf_points = 10;
};

}  // namespace toposcope::geometry
