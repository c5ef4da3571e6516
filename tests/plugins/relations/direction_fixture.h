// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Features that differ in their directions alone.

#include "relation_fixture.h"

namespace toposcope::test {

inline constexpr double degree = pi / 180;

inline Feature circle_about(const Vec3& normal) {
  return circle_feature(Vec3(1, 2, 3), normal, 1);
}
inline Feature segment_along(const Vec3& direction) {
  return segment_feature(Vec3(1, 0, 0), Vec3(Vec3(1, 0, 0) + direction));
}
/// From the z axis. \param angle  rad
inline Vec3 tilted(double angle) {
  return {std::sin(angle), 0, std::cos(angle)};
}

}  // namespace toposcope::test
