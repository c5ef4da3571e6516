// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "scene/buffer.h"

namespace toposcope {

/// What is no finite number is null.
inline SceneJson finite(double value) {
  return std::isfinite(value) ? SceneJson(value) : SceneJson(nullptr);
}

inline SceneJson data_uri(const std::string& png) {
  return png.empty() ? SceneJson(nullptr) : SceneJson("data:image/png;base64," + to_base64(png));
}

inline SceneJson text_or_null(const std::string& text) {
  return text.empty() ? SceneJson(nullptr) : SceneJson(text);
}

}  // namespace toposcope
