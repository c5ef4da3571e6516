// SPDX-License-Identifier: BSD-3-Clause
#include "picture.h"

#include <png.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"

namespace toposcope::bench {

View look(const Vec3& toward, const Vec3& up) {
  const Vec3 t = toward.normalized(), right = up.cross(t).normalized();
  return {right, t.cross(right), t};
}

Picture::Picture(int width, int height)
    : width_(samples * width),
      height_(samples * height),
      color_(static_cast<std::size_t>(width_) * height_, {1, 1, 1}),
      depth_(color_.size(), -std::numeric_limits<double>::infinity()) {}

void Picture::draw(const MeshView& mesh, const std::function<Rgb(const Triangle&)>& color, const View& view, int x,
                   int y, int size) {
  const auto project = [&](const Vec3& p) { return Vec3(p.dot(view.right), p.dot(view.up), p.dot(view.toward)); };
  Vec3 low = project(mesh.positions[mesh.triangles[0][0]]), high = low;
  for (const Triangle& t : mesh.triangles)
    for (Index v : t) {
      const Vec3 p = project(mesh.positions[v]);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const double scale = 0.94 * size * samples / std::max(high.x() - low.x(), high.y() - low.y());
  const double middle_x = (x + size / 2.0) * samples, middle_y = (y + size / 2.0) * samples;
  const Vec3 center = (low + high) / 2;
  for (const Triangle& t : mesh.triangles) {
    Vec3 corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = project(mesh.positions[t[k]]);
      corner[k] = Vec3(middle_x + scale * (p.x() - center.x()), middle_y - scale * (p.y() - center.y()), p.z());
    }
    const Vec3 &a = corner[0], &b = corner[1], &c = corner[2];
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (area == 0) continue;
    const Vec3 normal = (mesh.positions[t[1]] - mesh.positions[t[0]])
                            .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                            .stableNormalized();
    const auto light = static_cast<float>(0.35 + 0.65 * std::abs(normal.dot(view.toward)));
    const Rgb given = color(t);
    const std::array<float, 3> shade = {light * given[0] / 255, light * given[1] / 255, light * given[2] / 255};
    const int left = std::max(0, static_cast<int>(std::floor(std::min({a.x(), b.x(), c.x()}))));
    const int right = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({a.x(), b.x(), c.x()}))));
    const int top = std::max(0, static_cast<int>(std::floor(std::min({a.y(), b.y(), c.y()}))));
    const int bottom = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({a.y(), b.y(), c.y()}))));
    for (int row = top; row <= bottom; ++row)
      for (int column = left; column <= right; ++column) {
        const double px = column + 0.5, py = row + 0.5;
        const double wb = ((px - a.x()) * (c.y() - a.y()) - (py - a.y()) * (c.x() - a.x())) / area;
        const double wc = ((b.x() - a.x()) * (py - a.y()) - (b.y() - a.y()) * (px - a.x())) / area;
        if (wb < 0 || wc < 0 || wb + wc > 1) continue;
        const double depth = a.z() + wb * (b.z() - a.z()) + wc * (c.z() - a.z());
        const std::size_t at = static_cast<std::size_t>(row) * width_ + column;
        if (depth <= depth_[at]) continue;
        depth_[at] = depth;
        color_[at] = shade;
      }
  }
}

void Picture::save(const std::filesystem::path& file) const {
  const int width = width_ / samples, height = height_ / samples;
  std::vector<png_byte> bytes;
  bytes.reserve(3 * static_cast<std::size_t>(width) * height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      for (std::size_t channel = 0; channel < 3; ++channel) {
        float sum = 0;
        for (int i = 0; i < samples; ++i)
          for (int j = 0; j < samples; ++j)
            sum += color_[static_cast<std::size_t>(samples * row + i) * width_ + samples * column + j][channel];
        bytes.push_back(static_cast<png_byte>(std::lround(255 * sum / (samples * samples))));
      }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, file.c_str(), 0, bytes.data(), 0, nullptr) == 0)
    throw UsageError(file.string() + ": cannot be written (" + image.message + ")");
}

}  // namespace toposcope::bench
