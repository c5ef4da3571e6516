// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "toposcope/types.h"

namespace toposcope::normalise {

/// Faces that an operation makes are at least this round, or as round as they were.
inline constexpr double least_roundness = 0.2;

/// Twice the area along the normal.
inline Vec3 normal_of(const std::array<Vec3, 3>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]);
}

/// Whether a face may turn from one area normal to another: by at most 72 degrees at a time.
inline bool turns_little(const Vec3& before, const Vec3& after) {
  return before.dot(after) > 0.3 * before.norm() * after.norm();
}

/// 1 for equilateral triangles, 0 for degenerate ones.
inline double roundness(const std::array<Vec3, 3>& p) {
  const double squares = (p[1] - p[0]).squaredNorm() + (p[2] - p[1]).squaredNorm() + (p[0] - p[2]).squaredNorm();
  return squares > 0 ? 2 * std::sqrt(3.0) * normal_of(p).norm() / squares : 0;
}

}  // namespace toposcope::normalise
