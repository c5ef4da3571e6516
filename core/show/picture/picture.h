// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "picture/camera.h"
#include "picture/composition.h"
#include "picture/image.h"
#include "toposcope/context.h"

namespace toposcope {

enum class Background { white, dark, transparent };

struct PictureStyle {
  int width = 1200, height = 900;
  int samples = 3;               ///< per pixel and direction
  std::size_t directions = 192;  ///< that light comes from
  int light_pixels = 176;        ///< of a side of the maps that shadows are read from
  Background background = Background::white;
};

/// A small one: fewer samples of light.
PictureStyle thumbnail_style(int width = 240, int height = 180);

/// Samples per pixel and direction that are drawn: the style's, or fewer where triangles lie over each other so many
/// times that drawing them all would take minutes.
int drawn_samples(const Composition& composition, const Camera& camera, const PictureStyle& style);

/// Draws without a display; the same at any thread count.
Image draw_picture(const Composition& composition, const Camera& camera, const PictureStyle& style, Context& context);

}  // namespace toposcope
