// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "picture/composition.h"
#include "toposcope/context.h"

namespace toposcope {

/// Side of the maps that shadows are read from, in pixels: `wanted`, or fewer where faces lie over each other so many
/// times that drawing them all would take minutes.
/// \param directions  that there is a map of each
int light_map_side(const ShadedMesh& surface, std::size_t directions, int wanted);

/// Light from all around: brighter from above, a soft lamp at the viewer's upper left, a weak one behind. What the
/// surface itself hides of it is known from depth maps along many directions, so that hollows and undersides are dark.
class SkyLight {
 public:
  /// \param axes        of the camera: rows right, up, towards the viewer
  /// \param directions  how many; \param pixels  of a depth map's side, where light_map_side leaves it
  SkyLight(const ShadedMesh& surface, const Eigen::Matrix3d& axes, std::size_t directions, int pixels,
           Context& context);

  /// Light on a small piece of surface; 1 is about what a piece that faces the lamp has.
  float at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;
  /// The same where nothing is in its way.
  float open(const Eigen::Vector3f& normal) const;

 private:
  struct Direction {
    Eigen::Vector3f towards, u, v;  ///< the light comes from there
    float radiance = 0;
    std::vector<float> nearest;  ///< depth map: greatest height towards the light
  };
  void draw(const ShadedMesh& surface, Direction& direction) const;
  float visible(const Direction& direction, const Eigen::Vector3f& offset) const;

  std::vector<Direction> directions_;
  Eigen::Vector3f center_ = Eigen::Vector3f::Zero();
  float scale_ = 1;  ///< pixels per unit
  float bias_ = 0;   ///< mesh unit
  int pixels_;
};

}  // namespace toposcope
