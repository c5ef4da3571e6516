// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "picture/stand.h"

namespace toposcope {

/// From where an object is looked at.
struct View {
  double azimuth_deg = -55;   ///< about the upward axis; 0: from the front, 90: from the right
  double elevation_deg = 24;  ///< above the horizon
};

/// "iso", "front", "back", "left", "right", "top", "bottom", or "AZIMUTH,ELEVATION" in degrees.
/// \throw UsageError  it is none
View view_from(const std::string& text);

/// A pinhole camera. Image coordinates in pixels from the upper left corner.
struct Camera {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: right, up, towards the viewer
  Vec3 eye = Vec3::Zero();
  double focal = 1;  ///< in pixels
  double center_x = 0, center_y = 0;

  struct Projected {
    double x = 0, y = 0, w = 0;  ///< w: one over the distance along the axis
  };
  Projected operator()(const Vec3& p) const {
    const Vec3 q = axes * (p - eye);
    const double w = -1 / q.z();
    return {center_x + focal * q.x() * w, center_y - focal * q.y() * w, w};
  }
};

/// Looks from there so that all points fill a picture of that size but for a margin.
Camera camera_for(const View& view, const Stand& stand, std::span<const Vec3> points, int width, int height);

}  // namespace toposcope
