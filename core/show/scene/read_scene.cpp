// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <stdexcept>

#include "base/errors.h"
#include "base/json_text.h"
#include "result/shape_json.h"
#include "scene/buffer.h"
#include "scene/local_frame.h"
#include "scene/scene.h"

namespace toposcope {
namespace {

double number(const SceneJson& node) {
  return node.is_null() ? std::numeric_limits<double>::quiet_NaN() : node.get<double>();
}

void check_indices(const std::vector<Triangle>& triangles, std::size_t points) {
  for (const Triangle& triangle : triangles)
    for (const Index corner : triangle)
      if (corner >= points) throw std::invalid_argument("a triangle names a point that is not there");
}

DisplayMesh surface_from(const SceneJson& node) {
  DisplayMesh mesh;
  mesh.mesh_vertices = node.at("mesh_vertices").get<Index>();
  mesh.mesh_triangles = node.at("mesh_triangles").get<Index>();
  mesh.positions = read_points(node.at("positions"));
  mesh.triangles = read_triangles(node.at("triangles"));
  check_indices(mesh.triangles, mesh.positions.size());
  if (node.contains("vertex_ids")) mesh.vertex_ids = read_indices(node.at("vertex_ids"));
  if (!node.contains("labels")) return mesh;
  for (const Index label : read_indices(node.at("labels"))) mesh.labels.push_back(static_cast<std::uint8_t>(label));
  if (mesh.labels.size() != mesh.triangles.size())
    throw std::invalid_argument("there is not one label for each triangle");
  return mesh;
}

Drawing drawing_from(const SceneJson& node) {
  Drawing drawing;
  for (const SceneJson& line : node.at("lines")) drawing.lines.push_back(read_points(line));
  for (const SceneJson& each : node.at("patches")) {
    Patch& patch = drawing.patches.emplace_back();
    patch.positions = read_points(each.at("positions"));
    patch.triangles = read_triangles(each.at("triangles"));
    check_indices(patch.triangles, patch.positions.size());
  }
  if (node.contains("points")) drawing.points = read_points(node.at("points"));
  return drawing;
}

ShownWorkingSet set_from(const SceneJson& node, std::size_t shown_vertices) {
  ShownWorkingSet set;
  set.type = node.at("type").get<std::string>();
  set.vertices = read_indices(node.at("vertices"));
  set.size = node.at("size").get<std::size_t>();
  for (const Index v : set.vertices)
    if (v >= shown_vertices) throw std::invalid_argument("a working set names a vertex that is not there");
  return set;
}

ShownCandidate candidate_from(const SceneJson& node, std::size_t sets) {
  ShownCandidate candidate;
  candidate.feature = node.at("feature").get<std::string>();
  candidate.rank = node.at("rank").get<Index>();
  candidate.probability = number(node.at("probability"));
  candidate.evidence = number(node.at("evidence"));
  candidate.shape = node.at("shape").get<std::string>();
  candidate.parameters = parameters_from(node.at("parameters"));
  candidate.fit_error = number(node.at("fit_error"));
  candidate.working_sets = node.at("working_sets").get<std::vector<Index>>();
  for (const Index set : candidate.working_sets)
    if (set >= sets) throw std::invalid_argument("a candidate names a working set that is not there");
  candidate.drawing = drawing_from(node.at("drawing"));
  return candidate;
}

LocalFrame frame_from(const SceneJson& node) {
  const SceneJson& origin = node.at("origin");
  return {Vec3(origin.at(0).get<double>(), origin.at(1).get<double>(), origin.at(2).get<double>()),
          node.at("scale").get<double>()};
}

Scene scene_from(const SceneJson& root) {
  if (root.value("schema", "") != "toposcope.scene/1") throw std::invalid_argument("'schema' is not toposcope.scene/1");
  Scene scene;
  scene.title = root.at("title").get<std::string>();
  scene.result = root.at("result").dump();
  for (const auto& [name, feature] : root.at("result").at("features").items()) scene.features.push_back(name);
  const SceneJson& input = root.at("surfaces").at("input");
  scene.input = surface_from(input);
  if (input.contains("faces")) {
    scene.input_faces = read_indices(input.at("faces"));
  } else {
    for (Index t = 0; t < scene.input.triangles.size(); ++t) scene.input_faces.push_back(t);
  }
  if (scene.input_faces.size() != scene.input.triangles.size())
    throw std::invalid_argument("there is not one face for each triangle");
  if (root.at("surfaces").contains("normalised")) scene.normalised = surface_from(root.at("surfaces").at("normalised"));
  const std::size_t shown = scene.of_sets().positions.size();
  for (const SceneJson& node : root.at("working_sets")) {
    scene.sets.push_back(set_from(node, shown));
    scene.sets.back().saliency = number(node.at("saliency"));
    scene.sets.back().plugin = node.value("plugin", "");  // older ones do not have it
  }
  for (const SceneJson& node : root.at("all_working_sets")) scene.all_sets.push_back(set_from(node, shown));
  for (const ShownWorkingSet& set : scene.all_sets) scene.types.push_back(set.type);
  for (const SceneJson& node : root.at("candidates"))
    scene.candidates.push_back(candidate_from(node, scene.sets.size()));
  for (const SceneJson& node : root.at("found"))
    scene.found.push_back(
        {node.at("feature").get<std::string>(), drawing_from(node.at("drawing")), node.value("rank", Index{0})});
  scene.has_truth = !root.at("marks").is_null();
  for (const auto& [name, points] : root.at("marks").items()) {
    auto& mark = scene.marks.emplace_back(name, std::vector<Vec3>());
    for (const SceneJson& p : points)
      mark.second.emplace_back(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>());
  }
  if (root.contains("model")) scene.model = root.at("model").dump();
  if (root.contains("truth")) scene.truth = root.at("truth").dump();
  return root.contains("frame") ? in_world(std::move(scene), frame_from(root.at("frame"))) : scene;
}

}  // namespace

Scene read_scene(const std::string& text, const std::string& file) {
  const auto refusal = [&](const std::string& what) {
    return UsageError(file + ": is no scene: " + what +
                      "; write it anew with toposcope run --out (schemas/scene.schema.json)");
  };
  try {
    return scene_from(parse_json<SceneJson>(text, file));
  } catch (const SceneJson::exception& error) {
    throw refusal(json_fault(error));
  } catch (const std::invalid_argument& error) {
    throw refusal(error.what());
  }
}

}  // namespace toposcope
