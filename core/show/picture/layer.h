// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "picture/camera.h"
#include "picture/composition.h"

namespace toposcope {

/// Which triangle of a solid is nearest at each sample of a strip of rows.
class Layer {
 public:
  /// \param scale  samples per pixel and direction
  Layer(const ShadedMesh& solid, const Camera& camera, int scale);

  struct Sample {
    float w = 0;  ///< inverse depth; 0: nothing there
    Index triangle = 0;
  };
  /// Sample rows [first, last), `columns` each.
  void draw(int first, int last, int columns, std::vector<Sample>& samples) const;

  /// Of the corners of a triangle at the middle of a sample, correct in perspective.
  Eigen::Vector3f weights(Index triangle, int column, int row) const;
  /// Distance from the nearest edge, and the least height of the triangle; in samples.
  std::pair<float, float> from_edge(Index triangle, int column, int row) const;

  const ShadedMesh& solid() const { return solid_; }
  Vec3 point(Index triangle, const Eigen::Vector3f& weights) const;
  Eigen::Vector3f normal(Index triangle, const Eigen::Vector3f& weights) const;
  /// Linear, not as in the file.
  Eigen::Vector3f color(Index triangle, const Eigen::Vector3f& weights) const;

 private:
  const ShadedMesh& solid_;
  std::vector<Camera::Projected> corners_;
};

/// From an sRGB colour to light, and back.
Eigen::Vector3f to_linear(const Rgb& color);
float to_srgb(float linear);

}  // namespace toposcope
