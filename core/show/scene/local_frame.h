// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "scene/scene.h"

namespace toposcope {

/// Where points lie that are written in single precision: world = origin + scale * local.
struct LocalFrame {
  Vec3 origin = Vec3::Zero();
  double scale = 1;  ///< a power of two

  bool is_world() const { return scale == 1 && origin.isZero(0); }
  Vec3 to_local(const Vec3& p) const { return (p - origin) / scale; }
  Vec3 to_world(const Vec3& p) const { return origin + scale * p; }
};

/// The world, where single precision tells the points apart; else about the middle of their box, and of ordinary size
/// where the numbers would leave the range.
LocalFrame local_frame(std::span<const Vec3> points);

/// The scene with all its points in the frame. What the result and the model say stays as it is.
Scene in_local_frame(Scene scene, const LocalFrame& frame);
/// And back.
Scene in_world(Scene scene, const LocalFrame& frame);

}  // namespace toposcope
