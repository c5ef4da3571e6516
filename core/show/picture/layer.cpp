// SPDX-License-Identifier: BSD-3-Clause
#include "picture/layer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "picture/depth_tiles.h"

namespace toposcope {
namespace {

const std::array<float, 256>& linear_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double s = static_cast<double>(i) / 255;
      values[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table;
}

/// What lies far outside, or is no number, may be no int.
int within(int low, int high, double value) {
  if (!(value > low)) return low;
  return value < high ? static_cast<int>(value) : high;
}

}  // namespace

Eigen::Vector3f to_linear(const Rgb& color) {
  const auto& table = linear_table();
  return {table[color[0]], table[color[1]], table[color[2]]};
}

float to_srgb(float linear) {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
}

Layer::Layer(const ShadedMesh& solid, const Camera& camera, int scale)
    : solid_(solid), corners_(solid.positions.size()) {
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    corners_[i] = camera(solid.positions[i]);
    corners_[i].x = corners_[i].x * scale - 0.5;  // samples are counted by their middles
    corners_[i].y = corners_[i].y * scale - 0.5;
  }
}

void Layer::draw(int first, int last, int columns, std::vector<Sample>& samples) const {
  samples.assign(static_cast<std::size_t>(last - first) * static_cast<std::size_t>(columns), {});
  const auto row_of = [&](int y) {
    return samples.data() + static_cast<std::size_t>(y - first) * static_cast<std::size_t>(columns);
  };
  DepthTiles tiles(columns, last - first, 0);
  for (Index t = 0; t < solid_.triangles.size(); ++t) {
    const Triangle& triangle = solid_.triangles[t];
    const auto &a = corners_[triangle[0]], &b = corners_[triangle[1]], &c = corners_[triangle[2]];
    const int top = within(first, last, std::ceil(std::min({a.y, b.y, c.y})));
    const int bottom = within(first - 1, last - 1, std::floor(std::max({a.y, b.y, c.y})));
    if (top > bottom) continue;
    const int left = within(0, columns, std::ceil(std::min({a.x, b.x, c.x})));
    const int right = within(-1, columns - 1, std::floor(std::max({a.x, b.x, c.x})));
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double area = bx * cy - by * cx;
    if (left > right || area == 0 || !std::isfinite(area)) continue;
    const double scale = 1 / area, slack = -1e-9;
    const auto draw_piece = [&](const DrawnBox& piece) {
      for (int y = piece.top + first; y <= piece.bottom + first; ++y) {
        const double dy = y - a.y;
        Sample* row = row_of(y);
        for (int x = piece.left; x <= piece.right; ++x) {
          const double dx = x - a.x;
          const double beta = (dx * cy - dy * cx) * scale, gamma = (bx * dy - by * dx) * scale;
          if (beta < slack || gamma < slack || beta + gamma > 1 - slack) continue;
          const auto w = static_cast<float>(a.w + beta * (b.w - a.w) + gamma * (c.w - a.w));
          if (w > row[x].w) row[x] = {w, t};
        }
      }
    };
    tiles.visit(
        DrawnTriangle<double>{a.x, a.y - first, bx, by, cx, cy, a.w, b.w - a.w, c.w - a.w},
        {left, right, top - first, bottom - first}, -slack, [&](int x, int y) { return row_of(y + first)[x].w; },
        draw_piece);
  }
}

Eigen::Vector3f Layer::weights(Index triangle, int column, int row) const {
  const Triangle& t = solid_.triangles[triangle];
  const auto &a = corners_[t[0]], &b = corners_[t[1]], &c = corners_[t[2]];
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, dx = column - a.x, dy = row - a.y;
  const double area = bx * cy - by * cx;
  const double beta = (dx * cy - dy * cx) / area, gamma = (bx * dy - by * dx) / area;
  Vec3 weights((1 - beta - gamma) * a.w, beta * b.w, gamma * c.w);
  weights = weights.cwiseMax(0);
  return (weights / weights.sum()).cast<float>();
}

std::pair<float, float> Layer::from_edge(Index triangle, int column, int row) const {
  const Triangle& t = solid_.triangles[triangle];
  double nearest = 1e30, least_height = 1e30;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &p = corners_[t[k]], &q = corners_[t[(k + 1) % 3]], &r = corners_[t[(k + 2) % 3]];
    const double ex = q.x - p.x, ey = q.y - p.y, length = std::hypot(ex, ey);
    if (!(length > 0)) return {0.0F, 0.0F};
    nearest = std::min(nearest, std::abs(ex * (row - p.y) - ey * (column - p.x)) / length);
    least_height = std::min(least_height, std::abs(ex * (r.y - p.y) - ey * (r.x - p.x)) / length);
  }
  return {static_cast<float>(nearest), static_cast<float>(least_height)};
}

Vec3 Layer::point(Index triangle, const Eigen::Vector3f& weights) const {
  const Triangle& t = solid_.triangles[triangle];
  const Vec3 w = weights.cast<double>();
  return w[0] * solid_.positions[t[0]] + w[1] * solid_.positions[t[1]] + w[2] * solid_.positions[t[2]];
}

Eigen::Vector3f Layer::normal(Index triangle, const Eigen::Vector3f& weights) const {
  const auto& n = solid_.normals[triangle];
  const Eigen::Vector3f sum = weights[0] * n[0] + weights[1] * n[1] + weights[2] * n[2];
  return sum.norm() > 0 ? Eigen::Vector3f(sum.normalized()) : n[0];
}

Eigen::Vector3f Layer::color(Index triangle, const Eigen::Vector3f& weights) const {
  if (solid_.vertex_colors.empty()) return to_linear(solid_.triangle_colors[triangle]);
  const Triangle& t = solid_.triangles[triangle];
  const Rgb &a = solid_.vertex_colors[t[0]], &b = solid_.vertex_colors[t[1]], &c = solid_.vertex_colors[t[2]];
  // Of equal corners the weights count together, so that the line between colours runs through triangles' middles.
  const float of_a = weights[0] + (b == a ? weights[1] : 0) + (c == a ? weights[2] : 0);
  const float of_b = weights[1] + (c == b ? weights[2] : 0);
  return to_linear(of_a >= of_b && of_a >= weights[2] ? a : of_b >= weights[2] ? b : c);
}

}  // namespace toposcope
