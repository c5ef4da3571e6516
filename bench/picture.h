// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Pictures of meshes for the documentation: parallel projection, flat shading, no window.

#include <filesystem>
#include <functional>
#include <vector>

#include "io/mesh_io.h"

namespace toposcope::bench {

/// Where a picture is seen from: unit vectors, `toward` points to the viewer.
struct View {
  Vec3 right, up, toward;
};
/// \pre `up` and `toward` are not parallel
View look(const Vec3& toward, const Vec3& up);

class Picture {
 public:
  Picture(int width, int height);

  /// Draws the mesh into the square of `size` pixels whose upper left corner is (x, y).
  void draw(const MeshView& mesh, const std::function<Rgb(const Triangle&)>& color, const View& view, int x, int y,
            int size);
  /// \throw UsageError
  void save(const std::filesystem::path& png) const;

 private:
  static constexpr int samples = 2;  ///< each way, a pixel
  int width_, height_;               ///< in samples
  std::vector<std::array<float, 3>> color_;
  std::vector<double> depth_;
};

}  // namespace toposcope::bench
