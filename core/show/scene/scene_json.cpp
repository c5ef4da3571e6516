// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "result/palette.h"
#include "result/shape_json.h"
#include "scene/buffer.h"
#include "scene/local_frame.h"
#include "scene/scene.h"

namespace toposcope {
namespace {

SceneJson number(double value) {
  return std::isfinite(value) ? SceneJson(value) : SceneJson(nullptr);
}

SceneJson drawing_json(const Drawing& drawing) {
  SceneJson object = {{"lines", SceneJson::array()}, {"patches", SceneJson::array()}};
  for (const std::vector<Vec3>& line : drawing.lines) object["lines"].push_back(point_buffer(line));
  for (const Patch& patch : drawing.patches)
    object["patches"].push_back(
        {{"positions", point_buffer(patch.positions)}, {"triangles", index_buffer(patch.triangles)}});
  if (!drawing.points.empty()) object["points"] = point_buffer(drawing.points);
  return object;
}

/// Whether they are 0, 1, 2, ... up to `count`.
bool counts_up(const std::vector<Index>& values, std::size_t count) {
  for (Index i = 0; i < values.size(); ++i)
    if (values[i] != i) return false;
  return values.size() == count;
}

SceneJson surface_json(const DisplayMesh& mesh) {
  SceneJson surface = {{"mesh_vertices", mesh.mesh_vertices},           {"mesh_triangles", mesh.mesh_triangles},
                       {"shown_vertices", mesh.positions.size()},       {"shown_triangles", mesh.triangles.size()},
                       {"positions", quantised_buffer(mesh.positions)}, {"triangles", index_buffer(mesh.triangles)}};
  if (!mesh.vertex_ids.empty()) surface["vertex_ids"] = index_buffer(mesh.vertex_ids);
  return surface;
}

SceneJson surfaces_json(const Scene& scene) {
  SceneJson input = surface_json(scene.input);
  input["labels"] = byte_buffer(scene.input.labels);
  if (!scene.input.faces.empty() || !counts_up(scene.input_faces, scene.input.mesh_triangles))
    input["faces"] = index_buffer(scene.input_faces);
  SceneJson surfaces = {{"input", std::move(input)}};
  if (scene.normalised) surfaces["normalised"] = surface_json(*scene.normalised);
  return surfaces;
}

SceneJson candidate_json(const ShownCandidate& candidate) {
  return {{"feature", candidate.feature},
          {"rank", candidate.rank},
          {"probability", number(candidate.probability)},
          {"evidence", number(candidate.evidence)},
          {"shape", candidate.shape},
          {"parameters", parameters_json(candidate.parameters)},
          {"fit_error", number(candidate.fit_error)},
          {"working_sets", candidate.working_sets},
          {"drawing", drawing_json(candidate.drawing)}};
}

SceneJson palette_json(const Scene& scene) {
  SceneJson palette = {{"features", SceneJson::array()}, {"worksets", SceneJson::object()}};
  for (std::size_t f = 0; f < scene.features.size(); ++f) palette["features"].push_back(hex(feature_color(f)));
  for (std::size_t t = 0; t < scene.types.size(); ++t)
    palette["worksets"][scene.types[t]] = hex(working_set_color(scene.types[t], t));
  return palette;
}

SceneJson document(const Scene& scene, const std::string& program) {
  SceneJson root = {{"schema", "toposcope.scene/1"}, {"title", scene.title}, {"program", program}, {"unit", ""}};
  root["result"] = SceneJson::parse(scene.result);
  root["surfaces"] = surfaces_json(scene);
  root["working_sets"] = SceneJson::array();
  for (const ShownWorkingSet& set : scene.sets) {
    SceneJson object = {{"type", set.type},
                        {"vertices", index_buffer(set.vertices)},
                        {"size", set.size},
                        {"saliency", number(set.saliency)}};
    if (!set.plugin.empty()) object["plugin"] = set.plugin;
    root["working_sets"].push_back(std::move(object));
  }
  root["all_working_sets"] = SceneJson::array();
  for (const ShownWorkingSet& set : scene.all_sets)
    root["all_working_sets"].push_back(
        {{"type", set.type}, {"vertices", index_buffer(set.vertices)}, {"size", set.size}});
  root["candidates"] = SceneJson::array();
  for (const ShownCandidate& candidate : scene.candidates) root["candidates"].push_back(candidate_json(candidate));
  root["found"] = SceneJson::array();
  for (const FoundFeature& found : scene.found) {
    SceneJson object = {{"feature", found.feature}, {"drawing", drawing_json(found.drawing)}};
    if (found.rank > 0) object["rank"] = found.rank;
    root["found"].push_back(std::move(object));
  }
  root["marks"] = nullptr;
  if (scene.has_truth) root["marks"] = SceneJson::object();
  for (const auto& [feature, points] : scene.marks) {
    SceneJson list = SceneJson::array();
    for (const Vec3& p : points) list.push_back({p.x(), p.y(), p.z()});
    root["marks"][feature] = std::move(list);
  }
  if (!scene.truth.empty()) root["truth"] = SceneJson::parse(scene.truth);
  if (!scene.model.empty()) root["model"] = SceneJson::parse(scene.model);
  root["palette"] = palette_json(scene);
  return root;
}

}  // namespace

std::string to_json(const Scene& scene, const std::string& program) {
  const LocalFrame frame = local_frame(scene.input.positions);
  SceneJson root = document(frame.is_world() ? scene : in_local_frame(scene, frame), program);
  if (!frame.is_world())
    root["frame"] = {{"origin", {frame.origin.x(), frame.origin.y(), frame.origin.z()}}, {"scale", frame.scale}};
  return root.dump(-1, ' ', false, SceneJson::error_handler_t::replace) + "\n";
}

}  // namespace toposcope
