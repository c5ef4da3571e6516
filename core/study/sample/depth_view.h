// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "toposcope/context.h"

namespace toposcope {

/// Four neighbouring pixels of a depth image. Inverse depth is linear in the image on planes, so that it is
/// interpolated between them: w(x, y) = w + wx x + wy y + wxy x y with x, y from 0 to 1.
struct DepthCell {
  float w = 0, wx = 0, wy = 0, wxy = 0;  ///< 0: nothing was hit. At depth jumps the nearest pixel's, constant
  float plane = 1e30F;                   ///< distance of the surface's tangent plane from the viewpoint
  float weight = 0;                      ///< cosine between ray and normal; 0: no measurement of a surface
};

/// What a scanner sees from one viewpoint: a pinhole camera that looks at the origin.
struct DepthView {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: right, down, forwards
  Vec3 viewpoint = Vec3::Zero();
  double focal = 1;                     ///< in pixels
  double center_x = 0, center_y = 0;    ///< pixel of the optical axis
  std::uint32_t width = 0, height = 0;  ///< of the cells; those on the border saw nothing
  std::vector<DepthCell> cells;
};

struct DepthScanner {
  double pixel = 0;     ///< width of a pixel at the origin's distance
  double distance = 0;  ///< of the viewpoints from the origin
  double noise = 0;     ///< standard deviation along the ray
  std::uint64_t seed = 1;
};

/// Scans a closed, outward oriented mesh about the origin from distance * direction. Surfaces seen at less than 15
/// degrees, and pixels beside a jump in depth, are not measured, as with a triangulating scanner. The noise depends on
/// seed, view and pixel alone. \pre the mesh lies nearer to the origin than half the viewpoints' distance
std::vector<DepthView> scan_depths(const TriangleSoup& mesh, const std::vector<Vec3>& directions,
                                   const DepthScanner& scanner, Context& context);

}  // namespace toposcope
