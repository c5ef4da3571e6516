// SPDX-License-Identifier: BSD-3-Clause
#include "picture/stages.h"

#include <algorithm>
#include <map>

#include "base/errors.h"
#include "picture/layer.h"
#include "result/palette.h"

namespace toposcope {
namespace {

constexpr Rgb plain = {214, 211, 206};
constexpr double line_pixels = 2.1;        // radius of a tube in a picture of 900 pixels
constexpr double least_line_pixels = 0.9;  // and in any
constexpr double candidate_lines = 0.5;    // of it, for all candidates but the best
constexpr double clearly_better = 1.25;    // a view than one nearer to the usual one
constexpr double mark_radius = 1.3;        // of a mark, in tube radii

Rgb mixed(const Rgb& a, const Rgb& b, double part_of_b) {
  Rgb color;
  for (std::size_t k = 0; k < 3; ++k)
    color[k] = static_cast<std::uint8_t>(std::lround(a[k] + part_of_b * (b[k] - a[k])));
  return color;
}

/// Stands out from a surface of the same colour and from the background.
Rgb line_color(const Rgb& color, Background background) {
  return background == Background::dark ? mixed(color, {255, 255, 255}, 0.62) : mixed(color, {0, 0, 0}, 0.42);
}

/// Of each vertex the label that most of its triangles have; two in five make a label, so that a line of vertices keeps
/// it.
std::vector<std::uint8_t> vertex_labels(const DisplayMesh& mesh) {
  std::vector<std::map<std::uint8_t, int>> votes(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const Index v : mesh.triangles[t]) ++votes[v][mesh.labels[t]];
  std::vector<std::uint8_t> labels(votes.size(), 0);
  for (std::size_t v = 0; v < votes.size(); ++v) {
    int all = 0, most = 0;
    for (const auto& [label, count] : votes[v]) all += count;
    for (const auto& [label, count] : votes[v])
      if (label != 0 && count > most && 5 * count >= 2 * all) labels[v] = label, most = count;
  }
  return labels;
}

class Composer {
 public:
  Composer(const Scene& scene, Background background, int size) : scene_(scene), background_(background) {
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (const Vec3& p : scene.input.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const double pixel = 0.75 * (high - low).norm() / size;  // about
    composition_.line_radius = pixel * std::max(least_line_pixels, line_pixels * size / 900);
  }

  Composition take() { return std::move(composition_); }

  void mesh() {
    surface(scene_.of_sets());
    composition_.surface.triangle_colors.assign(composition_.surface.triangles.size(), plain);
    composition_.show_edges = true;
  }

  void worksets() {
    surface(scene_.of_sets());
    std::vector<Rgb>& colors = composition_.surface.vertex_colors;
    colors.assign(composition_.surface.positions.size(), plain);
    for (std::size_t t = 0; t < scene_.all_sets.size(); ++t)
      for (const Index v : scene_.all_sets[t].vertices) colors[v] = working_set_color(scene_.all_sets[t].type, t);
  }

  void candidates(const std::string& feature) {
    surface(scene_.of_sets());
    const Rgb color = color_of(feature);
    std::vector<Rgb>& colors = composition_.surface.vertex_colors;
    colors.assign(composition_.surface.positions.size(), plain);
    std::vector<const ShownCandidate*> offered;
    for (const ShownCandidate& each : scene_.candidates)
      if (each.feature == feature) offered.push_back(&each);
    for (std::size_t i = offered.size(); i-- > 0;) {  // the best last, over the others
      for (const Index set : offered[i]->working_sets)
        for (const Index v : scene_.sets[set].vertices) colors[v] = mixed(plain, color, i == 0 ? 0.85 : 0.4);
      draw(offered[i]->drawing, color, i == 0 ? 1 : candidate_lines);
    }
  }

  void found() {
    surface(scene_.input);
    for (const std::uint8_t label : vertex_labels(scene_.input))
      composition_.surface.vertex_colors.push_back(label == 0 ? plain : feature_color(label - 1U));
    for (const FoundFeature& each : scene_.found) draw(each.drawing, color_of(each.feature), 1);
  }

  void marks() {
    surface(scene_.input);
    composition_.surface.triangle_colors.assign(composition_.surface.triangles.size(), plain);
    for (const auto& [feature, points] : scene_.marks) {
      Drawing drawing;
      drawing.points = points;
      composition_.lines.append(tubes(drawing, mark_radius * composition_.line_radius, color_of(feature)));
    }
  }

 private:
  void surface(const DisplayMesh& mesh) {
    composition_.surface.positions = mesh.positions;
    composition_.surface.triangles = mesh.triangles;
    composition_.surface.normals = corner_normals(mesh.positions, mesh.triangles);
  }

  void draw(const Drawing& drawing, const Rgb& color, double thickness) {
    composition_.lines.append(tubes(drawing, thickness * composition_.line_radius, line_color(color, background_)));
    composition_.sheets.append(sheets(drawing, color));
  }

  Rgb color_of(const std::string& feature) const {
    const auto at = std::find(scene_.features.begin(), scene_.features.end(), feature);
    return feature_color(static_cast<std::size_t>(at - scene_.features.begin()));
  }

  const Scene& scene_;
  Background background_;
  Composition composition_;
};

}  // namespace

std::string_view to_string(Stage stage) {
  constexpr std::string_view names[] = {"mesh", "worksets", "candidates", "found", "marks"};
  return names[static_cast<std::size_t>(stage)];
}

Stage stage_from(const std::string& text) {
  for (const Stage stage : all_stages)
    if (to_string(stage) == text) return stage;
  throw UsageError("--stage " + text + ": expected mesh, worksets, candidates, found, marks or all");
}

Composition compose(const Scene& scene, Stage stage, const std::string& feature, Background background, int size) {
  Composer composer(scene, background, size);
  switch (stage) {
    case Stage::mesh:
      composer.mesh();
      break;
    case Stage::worksets:
      composer.worksets();
      break;
    case Stage::candidates:
      composer.candidates(feature);
      break;
    case Stage::found:
      composer.found();
      break;
    case Stage::marks:
      composer.marks();
      break;
  }
  return in_unit_box(composer.take());
}

std::vector<Vec3> extent(const Composition& composition) {
  std::vector<Vec3> points = composition.surface.positions;
  points.insert(points.end(), composition.lines.positions.begin(), composition.lines.positions.end());
  points.insert(points.end(), composition.sheets.positions.begin(), composition.sheets.positions.end());
  return points;
}

View best_view(const Scene& scene, const Stand& stand) {
  constexpr int width = 160, height = 120;
  Composition object;
  object.surface.positions = scene.input.positions;
  object.surface.triangles = scene.input.triangles;
  object = in_unit_box(std::move(object));
  const ShadedMesh& solid = object.surface;
  View best;
  double most = 0;
  std::vector<Layer::Sample> samples;
  for (int turn = 0; turn < 8; ++turn) {
    View view;
    view.azimuth_deg += 45.0 * turn;
    const Layer layer(solid, camera_for(view, stand, solid.positions, width, height), 1);
    layer.draw(0, height, width, samples);
    std::vector<double> seen(scene.features.size() + 1, 0);  // as areas: a view from near by is no better
    for (const Layer::Sample& sample : samples)
      if (sample.w > 0) seen[scene.input.labels[sample.triangle]] += 1 / std::pow(static_cast<double>(sample.w), 2);
    double score = 0;  // roots: a little of every feature rather than much of one
    for (std::size_t label = 1; label < seen.size(); ++label) score += std::sqrt(seen[label]);
    if (score > most * clearly_better) most = score, best = view;
  }
  return best;
}

std::string thumbnail_of(const Scene& scene, Context& context) {
  const Stand stand = stand_of(scene);
  return to_png(picture_of(scene, Stage::found, "", best_view(scene, stand), stand, thumbnail_style(), context));
}

Image picture_of(const Scene& scene, Stage stage, const std::string& feature, const View& view, const Stand& stand,
                 const PictureStyle& style, Context& context) {
  const Composition composition = compose(scene, stage, feature, style.background, std::min(style.width, style.height));
  const Camera camera = camera_for(view, stand, extent(composition), style.width, style.height);
  return draw_picture(composition, camera, style, context);
}

}  // namespace toposcope
