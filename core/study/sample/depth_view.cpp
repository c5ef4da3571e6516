// SPDX-License-Identifier: BSD-3-Clause
#include "sample/depth_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "toposcope/system/random.h"

namespace toposcope {

namespace {

constexpr float least_cosine = 0.2588F;  // 75 degrees from the normal
constexpr double steepest = 3.7320508;   // tan 75 degrees

struct Plane {
  Vec3 normal = Vec3::Zero();
  double offset = 0;
};

std::vector<Plane> planes_of(const TriangleSoup& mesh, Context& context) {
  std::vector<Plane> planes(mesh.triangles.size());
  context.parallel_for(planes.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const Triangle& t = mesh.triangles[f];
      const Vec3& a = mesh.positions[t[0]];
      planes[f].normal = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).normalized();
      planes[f].offset = planes[f].normal.dot(a);
    }
  });
  return planes;
}

/// Standard normal numbers, from which the pixels draw.
std::vector<float> normal_numbers(std::uint64_t seed) {
  std::vector<float> numbers(65536);
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    const auto pair = normal_pair(uniform_open(splitmix64(seed + i)), uniform_closed_open(splitmix64(seed + i + 1)));
    numbers[i] = static_cast<float>(pair[0]);
    numbers[i + 1] = static_cast<float>(pair[1]);
  }
  return numbers;
}

struct Corner {
  double x, y, w;
};

struct Pixel {
  float w = 0;      // inverse depth
  float plane = 0;  // distance of the triangle's plane from the viewpoint
};

/// A view's buffers, kept from view to view.
class Camera {
 public:
  Camera(const TriangleSoup& mesh, const std::vector<Plane>& planes, const DepthScanner& scanner,
         const std::vector<float>& noise)
      : mesh_(mesh), planes_(planes), scanner_(scanner), noise_(noise), corners_(mesh.positions.size()) {}

  void take(const Vec3& direction, std::uint64_t number, DepthView& view) {
    aim(direction, view);
    pixels_.assign(static_cast<std::size_t>(columns_) * rows_, {});
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const double plane = planes_[f].normal.dot(view.viewpoint) - planes_[f].offset;
      if (plane > 0) draw(mesh_.triangles[f], static_cast<float>(plane));
    }
    if (scanner_.noise > 0) add_noise(view, number);
    make_cells(view);
  }

 private:
  /// Looks at the origin and projects the vertices; the image is cut to the object and a border of two pixels.
  void aim(const Vec3& direction, DepthView& view) {
    const Vec3 forwards = -direction.normalized();
    Eigen::Index least = 0;
    forwards.cwiseAbs().minCoeff(&least);
    const Vec3 right = forwards.cross(Vec3::Unit(least)).normalized();
    view.axes << right.transpose(), forwards.cross(right).transpose(), forwards.transpose();
    view.viewpoint = -scanner_.distance * forwards;
    view.focal = scanner_.distance / scanner_.pixel;
    Vec2 low = Vec2::Constant(1e300), high = -low;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec3 p = view.axes * (mesh_.positions[i] - view.viewpoint);
      Corner& corner = corners_[i];
      corner.w = 1 / p.z();
      corner.x = view.focal * p.x() * corner.w;
      corner.y = view.focal * p.y() * corner.w;
      low = low.cwiseMin(Vec2(corner.x, corner.y));
      high = high.cwiseMax(Vec2(corner.x, corner.y));
    }
    view.center_x = 2 - std::floor(low.x());
    view.center_y = 2 - std::floor(low.y());
    columns_ = static_cast<int>(std::ceil(high.x()) + view.center_x) + 3;
    rows_ = static_cast<int>(std::ceil(high.y()) + view.center_y) + 3;
    for (Corner& corner : corners_) {
      corner.x += view.center_x;
      corner.y += view.center_y;
    }
  }

  void draw(const Triangle& t, float plane) {
    const Corner &a = corners_[t[0]], &b = corners_[t[1]], &c = corners_[t[2]];
    const int left = static_cast<int>(std::ceil(std::min({a.x, b.x, c.x})));
    const int right = static_cast<int>(std::max({a.x, b.x, c.x}));
    const int top = static_cast<int>(std::ceil(std::min({a.y, b.y, c.y})));
    const int bottom = static_cast<int>(std::max({a.y, b.y, c.y}));
    if (left > right || top > bottom) return;
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double area = bx * cy - by * cx;
    if (area == 0) return;
    const double scale = 1 / area, slack = -1e-9;  // pixels on a shared side belong to both, so that no ray slips by
    const double gx = ((b.w - a.w) * cy - (c.w - a.w) * by) * scale;
    const double gy = ((c.w - a.w) * bx - (b.w - a.w) * cx) * scale;
    for (int y = top; y <= bottom; ++y) {
      const double dy = y - a.y;
      Pixel* row = pixels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_);
      for (int x = left; x <= right; ++x) {
        const double dx = x - a.x;
        const double beta = (dx * cy - dy * cx) * scale, gamma = (bx * dy - by * dx) * scale;
        if (beta < slack || gamma < slack || beta + gamma > 1 - slack) continue;
        const auto w = static_cast<float>(a.w + gx * dx + gy * dy);
        if (w > row[x].w) row[x] = {w, plane};
      }
    }
  }

  void add_noise(const DepthView& view, std::uint64_t number) {
    const std::uint64_t key = splitmix64(scanner_.seed ^ splitmix64(number + 1));
    std::size_t at = 0;
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x, ++at) {
        Pixel& pixel = pixels_[at];
        if (pixel.w == 0) continue;
        const double along = scanner_.noise * static_cast<double>(noise_[splitmix64(key + at) % noise_.size()]);
        pixel.w = static_cast<float>(1 / (1 / static_cast<double>(pixel.w) + along / ray_length(view, x, y)));
      }
  }

  static double ray_length(const DepthView& view, double x, double y) {
    const double u = (x - view.center_x) / view.focal, v = (y - view.center_y) / view.focal;
    return std::sqrt(u * u + v * v + 1);
  }

  void make_cells(DepthView& view) const {
    view.width = static_cast<std::uint32_t>(columns_ - 1);
    view.height = static_cast<std::uint32_t>(rows_ - 1);
    view.cells.resize(static_cast<std::size_t>(view.width) * view.height);
    const auto jump = static_cast<float>(steepest * scanner_.pixel + 4 * scanner_.noise);
    for (std::uint32_t y = 0; y < view.height; ++y)
      for (std::uint32_t x = 0; x < view.width; ++x) {
        const Pixel* upper = pixels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + x;
        const Pixel* lower = upper + columns_;
        const float nearest = std::max(std::max(upper[0].w, upper[1].w), std::max(lower[0].w, lower[1].w));
        const float farthest = std::min(std::min(upper[0].w, upper[1].w), std::min(lower[0].w, lower[1].w));
        DepthCell& cell = view.cells[static_cast<std::size_t>(y) * view.width + x];
        if (nearest == 0) continue;
        cell = {nearest, 0, 0, 0, 1 / nearest, 0};
        if (farthest == 0 || 1 / farthest - 1 / nearest > jump) continue;
        const float plane = (upper[0].plane + upper[1].plane + lower[0].plane + lower[1].plane) / 4;
        const float middle = (upper[0].w + upper[1].w + lower[0].w + lower[1].w) / 4;
        const auto cosine = static_cast<float>(plane * middle / ray_length(view, x + 0.5, y + 0.5));
        if (cosine < least_cosine) continue;
        cell = {upper[0].w,
                upper[1].w - upper[0].w,
                lower[0].w - upper[0].w,
                upper[0].w - upper[1].w - lower[0].w + lower[1].w,
                plane,
                cosine};
      }
  }

  using Vec2 = Eigen::Vector2d;
  const TriangleSoup& mesh_;
  const std::vector<Plane>& planes_;
  const DepthScanner& scanner_;
  const std::vector<float>& noise_;
  std::vector<Corner> corners_;
  std::vector<Pixel> pixels_;
  int columns_ = 0, rows_ = 0;
};

}  // namespace

std::vector<DepthView> scan_depths(const TriangleSoup& mesh, const std::vector<Vec3>& directions,
                                   const DepthScanner& scanner, Context& context) {
  const std::vector<Plane> planes = planes_of(mesh, context);
  const std::vector<float> noise = normal_numbers(scanner.seed);
  std::vector<DepthView> views(directions.size());
  context.parallel_for(views.size(), 4, [&](std::size_t first, std::size_t last) {
    Camera camera(mesh, planes, scanner, noise);
    for (std::size_t v = first; v < last; ++v) camera.take(directions[v], v, views[v]);
  });
  return views;
}

}  // namespace toposcope
