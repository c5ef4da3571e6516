// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "picture/picture.h"
#include "scene/scene.h"

namespace toposcope {

/// What a picture of a scene shows; named as the page names its stages (web/src/state.ts).
enum class Stage {
  mesh,         ///< the normalised mesh, with its edges
  sets,         ///< working sets by type
  constructed,  ///< constructed features of one model feature
  found,        ///< the features found, with their shapes
  marks         ///< the truth's points
};
inline constexpr Stage all_stages[] = {Stage::mesh, Stage::sets, Stage::constructed, Stage::found, Stage::marks};
std::string_view to_string(Stage stage);
/// \throw UsageError  it is none
Stage stage_from(const std::string& text);

/// \param feature  of Stage::constructed
/// \param size     of the picture's smaller side in pixels: lines are so thick that they can be seen
Composition compose(const Scene& scene, Stage stage, const std::string& feature, Background background, int size);

/// All points that a picture must have room for.
std::vector<Vec3> extent(const Composition& composition);

/// Of eight views from around and above the one that shows most of the features found.
View best_view(const Scene& scene, const Stand& stand);

/// What was found, small, as a PNG file.
std::string thumbnail_of(const Scene& scene, Context& context);

/// Composes and draws.
Image picture_of(const Scene& scene, Stage stage, const std::string& feature, const View& view, const Stand& stand,
                 const PictureStyle& style, Context& context);

}  // namespace toposcope
