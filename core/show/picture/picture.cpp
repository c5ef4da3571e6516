// SPDX-License-Identifier: BSD-3-Clause
#include "picture/picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "picture/layer.h"
#include "picture/sky_light.h"

namespace toposcope {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr int strip_samples = 1 << 17;  // drawn at a time: a few megabytes, and each strip looks at all triangles
constexpr float behind = 0.28F;         // what a hidden line keeps of its colour
constexpr float sheet_opacity = 0.45F;
constexpr float hidden_sheet = 0.07F;
constexpr float edge_darkness = 0.34F;
constexpr float gloss = 0.10F;
constexpr float outline_darkness = 0.4F;

Vec3f background_of(Background background) {
  return background == Background::dark ? to_linear({22, 25, 30}) : Vec3f(Vec3f::Ones());
}

/// Samples of one pixel on about the same piece of surface: lit once.
struct Piece {
  float w = 0;
  Vec3 point = Vec3::Zero();
  Vec3f normal = Vec3f::Zero();
  Vec3f albedo = Vec3f::Zero();  // summed over its samples
  float weight = 0;
};

class Painter {
 public:
  Painter(const Composition& composition, const Camera& camera, const PictureStyle& style, Context& context)
      : composition_(composition),
        camera_(camera),
        style_(style),
        surface_(composition.surface, camera, style.samples),
        lines_(composition.lines, camera, style.samples),
        sheets_(composition.sheets, camera, style.samples),
        light_(composition.surface, camera.axes, style.directions, style.light_pixels, context),
        image_{style.width, style.height, {}} {
    image_.rgba.resize(4 * static_cast<std::size_t>(style.width) * static_cast<std::size_t>(style.height));
    lamp_ = (camera.axes.transpose() * Vec3(-0.5, 0.72, 0.8).normalized()).cast<float>();
  }

  void paint(int first_row, int last_row) {
    Strip strip;
    const int columns = style_.width * style_.samples;
    surface_.draw(first_row * style_.samples, last_row * style_.samples, columns, strip.surface);
    lines_.draw(first_row * style_.samples, last_row * style_.samples, columns, strip.lines);
    sheets_.draw(first_row * style_.samples, last_row * style_.samples, columns, strip.sheets);
    for (int y = first_row; y < last_row; ++y)
      for (int x = 0; x < style_.width; ++x) pixel(x, y, first_row, strip);
  }

  Image take() { return std::move(image_); }

 private:
  struct Strip {
    std::vector<Layer::Sample> surface, lines, sheets;
  };

  void pixel(int x, int y, int first_row, const Strip& strip) {
    const int s = style_.samples, columns = style_.width * s;
    std::vector<Piece> pieces;
    Vec3f drawn = Vec3f::Zero();  // lines and sheets
    float cover = 0;
    for (int j = 0; j < s; ++j)
      for (int i = 0; i < s; ++i) {
        const int column = x * s + i, row = y * s + j;
        const auto at = static_cast<std::size_t>((row - first_row * s) * columns + column);
        const Layer::Sample& here = strip.surface[at];
        float rest = 1;  // what lines and sheets let through
        over(lines_, strip.lines[at], here.w, column, row, 1, behind, drawn, rest);
        over(sheets_, strip.sheets[at], here.w, column, row, sheet_opacity, hidden_sheet, drawn, rest);
        if (here.w > 0) gather(here, column, row, rest, pieces);
        cover += here.w > 0 ? 1 : 1 - rest;
      }
    const auto n = static_cast<float>(s * s);
    Vec3f light = drawn;
    for (const Piece& piece : pieces) light += lit(piece);
    write(x, y, light / n, cover / n);
  }

  /// Lays a sample of lines or sheets over what is behind.
  void over(const Layer& layer, const Layer::Sample& sample, float surface, int column, int row, float opacity,
            float hidden, Vec3f& drawn, float& rest) const {
    if (sample.w == 0) return;
    // Shapes lie in the surface, half of a line within it: a line's thickness more is not hidden.
    const double slack = 2.5 * composition_.line_radius;
    const bool seen = surface == 0 || 1 / static_cast<double>(sample.w) < 1 / static_cast<double>(surface) + slack;
    const Vec3f weights = layer.weights(sample.triangle, column, row);
    const Vec3f normal = towards_viewer(layer.normal(sample.triangle, weights), layer.point(sample.triangle, weights));
    const float alpha = rest * (seen ? opacity : hidden);
    drawn += alpha * shaded(layer.color(sample.triangle, weights), light_.open(normal), normal);
    rest -= alpha;
  }

  void gather(const Layer::Sample& sample, int column, int row, float weight, std::vector<Piece>& pieces) const {
    const Vec3f weights = surface_.weights(sample.triangle, column, row);
    const Vec3 point = surface_.point(sample.triangle, weights);
    const Vec3f normal = towards_viewer(surface_.normal(sample.triangle, weights), point);
    Vec3f albedo = surface_.color(sample.triangle, weights);
    if (composition_.show_edges) albedo *= 1 - edge(sample.triangle, column, row);
    for (Piece& piece : pieces)
      if (std::abs(piece.w - sample.w) < 0.004F * piece.w && piece.normal.dot(normal) > 0.97F) {
        piece.albedo += weight * albedo;
        piece.weight += weight;
        return;
      }
    pieces.push_back({sample.w, point, normal, weight * albedo, weight});
  }

  /// How dark the edges of a triangle are there; nothing where it is too small to tell them apart.
  float edge(Index triangle, int column, int row) const {
    const auto [distance, height] = surface_.from_edge(triangle, column, row);
    const auto s = static_cast<float>(style_.samples);
    const float line = std::clamp(1.1F - 2.0F * distance / s, 0.0F, 1.0F);
    return edge_darkness * line * std::clamp((height / s - 2.0F) / 5.0F, 0.0F, 1.0F);
  }

  /// Open meshes show their inside.
  Vec3f towards_viewer(const Vec3f& normal, const Vec3& point) const {
    return normal.dot((camera_.eye - point).cast<float>()) < 0 ? Vec3f(-normal) : normal;
  }

  Vec3f lit(const Piece& piece) const {
    const float open = light_.open(piece.normal), direct = light_.at(piece.point.cast<float>(), piece.normal);
    const float light = open * with_bounces(std::min(1.0F, direct / open));
    const float shine = highlight(piece.normal, piece.point) * std::min(1.0F, light);
    return piece.albedo * (soft(light) * outline(piece)) + Vec3f::Constant(piece.weight * shine);
  }

  /// What turns away from the viewer is a little darker, so that pale things stand out from a white page.
  float outline(const Piece& piece) const {
    const float facing = piece.normal.dot((camera_.eye - piece.point).normalized().cast<float>());
    const float away = 1 - std::clamp(facing, 0.0F, 1.0F);
    return 1 - outline_darkness * away * away * away;
  }

  /// Part of the light that a piece has when pale surfaces around it throw light back (Jimenez et al. 2016, a fit to
  /// traced light for an albedo of 0.7).
  static float with_bounces(float seen) { return std::max(seen, ((1.096F * seen - 2.715F) * seen + 2.619F) * seen); }

  /// Bright light is held back, so that pale surfaces keep their form.
  static float soft(float light) {
    constexpr float knee = 0.7F, room = 0.42F;
    return light < knee ? light : knee + room * (1 - std::exp((knee - light) / room));
  }

  Vec3f shaded(const Vec3f& albedo, float light, const Vec3f& normal) const {
    return albedo * (0.35F + 0.65F * light) + Vec3f::Constant(0.5F * gloss * shine_of(normal, camera_.axes.row(2)));
  }

  float highlight(const Vec3f& normal, const Vec3& point) const {
    return gloss * shine_of(normal, (camera_.eye - point).normalized());
  }

  float shine_of(const Vec3f& normal, const Vec3& to_viewer) const {
    const Vec3f half = (lamp_ + to_viewer.cast<float>()).normalized();
    return std::pow(std::max(0.0F, normal.dot(half)), 24.0F);
  }

  /// \param light  already weighted by what is covered
  void write(int x, int y, const Vec3f& light, float cover) {
    std::uint8_t* pixel =
        image_.rgba.data() +
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(style_.width) + static_cast<std::size_t>(x));
    Vec3f color = light;
    float alpha = 1;
    if (style_.background == Background::transparent) {
      alpha = cover;
      if (cover > 0) color /= cover;
    } else {
      color += (1 - cover) * background_of(style_.background);
    }
    for (int k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>(std::lround(255 * to_srgb(color[k])));
    pixel[3] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(alpha, 0.0F, 1.0F)));
  }

  const Composition& composition_;
  const Camera& camera_;
  const PictureStyle& style_;
  Layer surface_, lines_, sheets_;
  SkyLight light_;
  Image image_;
  Vec3f lamp_;
};

}  // namespace

PictureStyle thumbnail_style(int width, int height) {
  PictureStyle style;
  style.width = width;
  style.height = height;
  style.samples = 2;
  style.directions = 24;
  style.light_pixels = 64;
  style.background = Background::transparent;  // pages are light or dark
  return style;
}

int drawn_samples(const Composition& composition, const Camera& camera, const PictureStyle& style) {
  constexpr double most_drawn = 1e9;  // of all triangles: a cup in a picture of usual size has 3e7
  const double frame = static_cast<double>(style.width) * style.height;
  double pixels = 0;
  for (const ShadedMesh* mesh : {&composition.surface, &composition.lines, &composition.sheets})
    for (const Triangle& t : mesh->triangles) {
      const Camera::Projected a = camera(mesh->positions[t[0]]), b = camera(mesh->positions[t[1]]),
                              c = camera(mesh->positions[t[2]]);
      const double area = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
      pixels += area < frame ? area : frame;
    }
  int samples = style.samples;
  while (samples > 1 && pixels * samples * samples > most_drawn) --samples;
  return samples;
}

Image draw_picture(const Composition& composition, const Camera& camera, const PictureStyle& wanted, Context& context) {
  PictureStyle style = wanted;
  style.samples = drawn_samples(composition, camera, wanted);
  Painter painter(composition, camera, style, context);
  const int rows = std::max(1, strip_samples / (style.width * style.samples * style.samples));
  const std::size_t strips = static_cast<std::size_t>((style.height + rows - 1) / rows);
  context.parallel_for(strips, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const int top = static_cast<int>(i) * rows;
      painter.paint(top, std::min(style.height, top + rows));
    }
  });
  return painter.take();
}

}  // namespace toposcope
