// SPDX-License-Identifier: BSD-3-Clause
#include "scene/stored_result.h"

#include <set>

#include "base/errors.h"
#include "base/json_text.h"
#include "mesh/content_hash.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;

fs::path place_of(const fs::path& given, const StoredResult& result, const fs::path& file) {
  fs::path mesh = given.empty() ? result.mesh : given;
  std::error_code ignored;
  if (!fs::is_regular_file(mesh, ignored))
    throw MeshError(file.string() + ": its mesh " + mesh.string() +
                    " is not there; call from the folder where toposcope run was called, or give --mesh FILE");
  return mesh;
}

/// The last feature that has a face gives it its label, as in labels.ply.
void add_labels(LabelledMesh& labelled) {
  const MeshView& view = labelled.mesh.view();
  labelled.labels.assign(view.face_count(), 0);
  std::vector<std::uint8_t> of_face(labelled.mesh.input_faces(), 0);
  for (std::size_t f = 0; f < labelled.result.features.size() && f < most_labels; ++f)
    for (const Index face : labelled.result.features[f].faces)
      if (face < of_face.size()) of_face[face] = static_cast<std::uint8_t>(f + 1);
  for (Index t = 0; t < view.face_count(); ++t) labelled.labels[t] = of_face[labelled.mesh.face_origin()[t]];
}

/// The corners of a feature's triangles.
std::vector<Vec3> region_of(const LabelledMesh& labelled, const StoredFeature& feature) {
  const MeshView& view = labelled.mesh.view();
  const std::set<Index> faces(feature.faces.begin(), feature.faces.end());
  std::vector<bool> inside(view.vertex_count(), false);
  for (Index t = 0; t < view.face_count(); ++t)
    if (faces.contains(labelled.mesh.face_origin()[t]))
      for (const Index v : view.triangles[t]) inside[v] = true;
  std::vector<Vec3> region;
  for (Index v = 0; v < view.vertex_count(); ++v)
    if (inside[v]) region.push_back(view.positions[v]);
  return region;
}

}  // namespace

std::size_t LabelledMesh::number_of(const std::string& feature) const {
  std::size_t number = 0;
  while (result.features.at(number).name != feature) ++number;
  return number;
}

LabelledMesh read_labelled_mesh(const fs::path& file, const fs::path& mesh) {
  StoredResult result = read_result(file);
  const fs::path place = place_of(mesh, result, file);
  LabelledMesh labelled{std::move(result), read_repaired_mesh(place).mesh, {}, {}};
  if (const std::string hash = content_hash(labelled.mesh); hash != labelled.result.mesh_hash)
    throw MeshError(place.string() + ": is not the mesh that " + file.string() + " speaks of, or was changed since " +
                    "(sha256 of its content " + hash.substr(0, 12) + "..., not " +
                    labelled.result.mesh_hash.substr(0, 12) + "...); run toposcope run on it, or give --mesh FILE");
  add_labels(labelled);
  for (const StoredFeature& feature : labelled.result.features)
    if (feature.present)
      labelled.found.push_back({feature.name, draw_shape(feature.parameters, region_of(labelled, feature))});
  return labelled;
}

void require_of_result(const Scene& scene, const fs::path& scene_file, const StoredResult& result,
                       const fs::path& result_file) {
  using Json = nlohmann::json;
  if (Json::parse(scene.result) != Json::parse(result.text))
    throw UsageError(scene_file.string() + ": is of another run than " + result_file.string() +
                     "; run toposcope run --out again, or remove the scene to show what the result and its mesh tell");
}

Scene scene_of(const LabelledMesh& labelled, const Truth* truth) {
  std::vector<std::string> names;
  for (const StoredFeature& feature : labelled.result.features) names.push_back(feature.name);
  Scene scene = make_scene(labelled.mesh, labelled.labels, labelled.result.text, labelled.found, names, truth);
  scene.title = scene_title(labelled.result.mesh, labelled.result.model);
  return scene;
}

}  // namespace toposcope
