// SPDX-License-Identifier: BSD-3-Clause
#include "picture/sky_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "picture/depth_tiles.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/spread_directions.h"

namespace toposcope {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr float nothing = -1e30F;
constexpr float exposure = 1.3F;

struct Ball {
  Vec3 center;
  double radius;
};

/// About all points, as wide as their box asks for.
Ball ball_about(const std::vector<Vec3>& points) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  Ball ball{points.empty() ? Vec3(Vec3::Zero()) : Vec3((low + high) / 2), 1e-30};
  for (const Vec3& p : points) ball.radius = std::max(ball.radius, (p - ball.center).norm());
  return ball;
}

/// By direction towards the light in the camera's frame.
float radiance(const Vec3f& d) {
  static const Vec3f lamp = Vec3f(-0.55F, 0.78F, 0.62F).normalized();
  static const Vec3f behind = Vec3f(0.75F, 0.25F, -0.6F).normalized();
  const auto lobe = [&](const Vec3f& axis, float sharpness) {
    return std::pow(std::max(0.0F, d.dot(axis)), sharpness);
  };
  return std::max(0.2F, 0.55F + 0.36F * d.y()) + 2.1F * lobe(lamp, 8) + 0.5F * lobe(behind, 6);
}

/// Of light under a cosine. It sets in gently: with the cosine itself each direction would end in a line of its own,
/// and what grazes would show the facets of smooth things.
float spread(float cosine) {
  return cosine > 0 ? cosine * cosine / (cosine + 0.25F) : 0;
}

}  // namespace

int light_map_side(const ShadedMesh& surface, std::size_t directions, int wanted) {
  constexpr double most_drawn = 5e8;  // pixels of all triangles in all maps, about: ordinary objects have 2e7
  constexpr int fewest = 24;
  double area = 0;
  for (const Triangle& t : surface.triangles) {
    const Vec3& a = surface.positions[t[0]];
    area += (surface.positions[t[1]] - a).cross(surface.positions[t[2]] - a).norm() / 2;
  }
  // Seen from all sides a triangle shows half of its area, and the box around it has twice that.
  const double side = 2 * ball_about(surface.positions).radius;
  const double drawn = area / (side * side) * wanted * wanted * static_cast<double>(directions);
  if (!(drawn > most_drawn)) return wanted;
  return std::max(std::min(fewest, wanted), static_cast<int>(wanted * std::sqrt(most_drawn / drawn)));
}

SkyLight::SkyLight(const ShadedMesh& surface, const Eigen::Matrix3d& axes, std::size_t directions, int pixels,
                   Context& context)
    : directions_(directions), pixels_(light_map_side(surface, directions, pixels)) {
  const Ball ball = ball_about(surface.positions);
  center_ = ball.center.cast<float>();
  scale_ = static_cast<float>((pixels_ - 4) / 2.0 / ball.radius);
  bias_ = 1.5F / scale_;

  const std::vector<Vec3> towards = spread_directions(directions);
  context.parallel_for(directions, 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Direction& direction = directions_[i];
      const Vec3 u = any_perpendicular(towards[i]);
      direction.towards = towards[i].cast<float>();
      direction.u = u.cast<float>();
      direction.v = towards[i].cross(u).cast<float>();
      direction.radiance = radiance((axes * towards[i]).cast<float>());
      draw(surface, direction);
    }
  });
  // A piece that faces the lamp has a little more than 1.
  const float most = open((axes.transpose() * Vec3(-0.55, 0.78, 0.62).normalized()).cast<float>());
  for (Direction& direction : directions_) direction.radiance *= exposure / most;
}

void SkyLight::draw(const ShadedMesh& surface, Direction& direction) const {
  direction.nearest.assign(static_cast<std::size_t>(pixels_) * static_cast<std::size_t>(pixels_), nothing);
  const auto depth_at = [&](int x, int y) -> float& {
    return direction.nearest[static_cast<std::size_t>(y * pixels_ + x)];
  };
  DepthTiles tiles(pixels_, pixels_, nothing);
  std::vector<Vec3f> corners(surface.positions.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3f q = surface.positions[i].cast<float>() - center_;
    corners[i] = {q.dot(direction.u) * scale_ + static_cast<float>(pixels_) / 2,
                  q.dot(direction.v) * scale_ + static_cast<float>(pixels_) / 2, q.dot(direction.towards)};
  }
  for (const Triangle& t : surface.triangles) {
    const Vec3f &a = corners[t[0]], &b = corners[t[1]], &c = corners[t[2]];
    const float bx = b.x() - a.x(), by = b.y() - a.y(), cx = c.x() - a.x(), cy = c.y() - a.y();
    const float area = bx * cy - by * cx;
    if (area == 0 || !std::isfinite(area)) continue;
    const auto pixel_of = [&](float place) {
      return static_cast<int>(std::clamp(place, 0.0F, static_cast<float>(pixels_ - 1)));
    };
    const int left = pixel_of(std::ceil(std::min({a.x(), b.x(), c.x()})));
    const int right = pixel_of(std::max({a.x(), b.x(), c.x()}));
    const int top = pixel_of(std::ceil(std::min({a.y(), b.y(), c.y()})));
    const int bottom = pixel_of(std::max({a.y(), b.y(), c.y()}));
    const auto draw_piece = [&](const DrawnBox& piece) {
      for (int y = piece.top; y <= piece.bottom; ++y)
        for (int x = piece.left; x <= piece.right; ++x) {
          const float dx = static_cast<float>(x) - a.x(), dy = static_cast<float>(y) - a.y();
          const float beta = (dx * cy - dy * cx) / area, gamma = (bx * dy - by * dx) / area;
          if (beta < -1e-4F || gamma < -1e-4F || beta + gamma > 1.0001F) continue;
          float& pixel = depth_at(x, y);
          pixel = std::max(pixel, a.z() + beta * (b.z() - a.z()) + gamma * (c.z() - a.z()));
        }
    };
    tiles.visit(DrawnTriangle<float>{a.x(), a.y(), bx, by, cx, cy, a.z(), b.z() - a.z(), c.z() - a.z()},
                {left, right, top, bottom}, 1e-4F, depth_at, draw_piece);
  }
}

/// Part of the four pixels around a place that nothing is above of.
float SkyLight::visible(const Direction& direction, const Vec3f& offset) const {
  const float x = offset.dot(direction.u) * scale_ + static_cast<float>(pixels_) / 2;
  const float y = offset.dot(direction.v) * scale_ + static_cast<float>(pixels_) / 2;
  const float height = offset.dot(direction.towards) + bias_;
  const int column = std::clamp(static_cast<int>(x), 0, pixels_ - 2),
            row = std::clamp(static_cast<int>(y), 0, pixels_ - 2);
  const float fx = std::clamp(x - static_cast<float>(column), 0.0F, 1.0F);
  const float fy = std::clamp(y - static_cast<float>(row), 0.0F, 1.0F);
  const float* upper = direction.nearest.data() + static_cast<std::size_t>(row * pixels_ + column);
  const float* lower = upper + pixels_;
  const auto free = [&](float nearest) { return nearest <= height ? 1.0F : 0.0F; };
  return (free(upper[0]) * (1 - fx) + free(upper[1]) * fx) * (1 - fy) +
         (free(lower[0]) * (1 - fx) + free(lower[1]) * fx) * fy;
}

float SkyLight::at(const Vec3f& point, const Vec3f& normal) const {
  // A little off the surface, which is drawn in the maps as coarsely as their pixels.
  const Vec3f offset = point - center_ + normal * bias_;
  float sum = 0;
  for (const Direction& direction : directions_)
    if (const float part = spread(normal.dot(direction.towards)); part > 0)
      sum += part * direction.radiance * visible(direction, offset);
  return sum;
}

float SkyLight::open(const Vec3f& normal) const {
  float sum = 0;
  for (const Direction& direction : directions_) sum += spread(normal.dot(direction.towards)) * direction.radiance;
  return sum;
}

}  // namespace toposcope
