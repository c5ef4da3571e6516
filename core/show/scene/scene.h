// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh_io.h"
#include "result/result.h"
#include "scene/display_mesh.h"
#include "scene/drawing.h"
#include "truth/truth.h"

namespace toposcope {

/// Vertices of the mesh after the filters that belong to a type of working sets, as shown.
struct ShownWorkingSet {
  std::string type;
  std::vector<Index> vertices;  ///< shown ones, ascending
  std::size_t size = 0;         ///< vertices of the mesh, shown or not
  double saliency = 1;
  std::string plugin = {};  ///< that found the set; empty: not known
};

/// A constructed feature that a model feature could take.
struct ShownCandidate {
  std::string feature;
  Index rank = 0;          ///< as in the alternatives of the result, from 1
  double probability = 0;  ///< posterior; not a number where there is none
  double evidence = 0;     ///< log likelihood ratio, nats
  std::string shape;
  std::vector<ShapeParameter> parameters;
  double fit_error = 0;
  std::vector<Index> working_sets;  ///< into Scene::working_sets
  Drawing drawing;
};

struct FoundFeature {
  std::string feature;
  Drawing drawing;
  Index rank = 0;  ///< of its candidate; 0: not known
};

/// All that page, pictures and exports show of one mesh under a model, at every station of the path.
struct Scene {
  std::string title;
  std::string result;                      ///< result.json whole
  std::vector<std::string> features;       ///< names, in the order of the result; label i + 1 is feature i
  DisplayMesh input;                       ///< `faces` and labels are of the mesh's triangles
  std::vector<Index> input_faces;          ///< per shown triangle of `input` the face of the file
  std::optional<DisplayMesh> normalised;   ///< after the filters; absent where they changed nothing
  std::vector<std::string> types;          ///< of working sets
  std::vector<ShownWorkingSet> all_sets;   ///< per type; a vertex that several hold goes with the smallest
  std::vector<ShownWorkingSet> sets;       ///< that candidates were made of
  std::vector<ShownCandidate> candidates;  ///< best first within a feature
  std::vector<FoundFeature> found;
  std::vector<std::pair<std::string, std::vector<Vec3>>> marks;  ///< of the truth
  bool has_truth = false;
  std::string model;  ///< its file as JSON; empty: not known
  std::string truth;  ///< its file as JSON, without the parts; empty: there is none

  const DisplayMesh& of_sets() const { return normalised ? *normalised : input; }
};

struct SceneLimits {
  std::size_t triangles = shown_triangles_limit;  ///< of each surface
  std::size_t candidates = 40;  ///< of each feature; those that an alternative names come on top. 0: what was found
                                ///< alone, no candidates, working sets or normalised mesh
};

/// A small scene: what was found.
inline constexpr SceneLimits found_alone = {20000, 0};

/// The scene of a run. \param truth  null: not known
Scene make_scene(const Analysis& analysis, const Model& model, const Result& result, const Truth* truth,
                 const SceneLimits& limits = {});

/// The last station alone, of what a result says and its mesh (no normalised mesh, no working sets, no candidates).
/// \param labels  one per triangle of the mesh
Scene make_scene(const Mesh& input, const std::vector<std::uint8_t>& labels, std::string result_json,
                 std::vector<FoundFeature> found, std::vector<std::string> features, const Truth* truth,
                 const SceneLimits& limits = {});

/// "cup.ply · cup"
std::string scene_title(const std::filesystem::path& mesh, const std::string& model);

/// Labels are single bytes; features beyond so many have none.
inline constexpr std::size_t most_labels = 255;

/// One label per triangle of the input: 0 none, 1 + the number of the last feature that has it.
std::vector<std::uint8_t> labels_of(const Result& result, Index triangles);

/// The document "toposcope.scene/1" (schemas/scene.schema.json), on one line.
/// \param program  name and version
std::string to_json(const Scene& scene, const std::string& program);

/// Reads it back. \param file  for messages \throw UsageError  it is no scene
Scene read_scene(const std::string& text, const std::string& file);

}  // namespace toposcope
