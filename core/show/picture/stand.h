// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/scene.h"

namespace toposcope {

/// How an object stands: two of its own directions, at right angles.
struct Stand {
  Vec3 up = Vec3::UnitZ();
  Vec3 front = -Vec3::UnitY();
};

/// Told by the model's spatial associations and the features found; where these say nothing, up is z and the front -y.
Stand stand_of(const Scene& scene);

/// What has that upward axis: "x", "y", "z", "-x", "-y", "-z". \throw UsageError  it is none
Stand stand_from(const std::string& up);

}  // namespace toposcope
