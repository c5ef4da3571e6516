// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>

#include "scene/scene.h"

namespace toposcope {
namespace {

constexpr Index none = std::numeric_limits<Index>::max();

/// Gathers what there is to show of a run.
class SceneMaker {
 public:
  SceneMaker(const Analysis& analysis, const Model& model, const Result& result, const SceneLimits& limits,
             Scene& scene)
      : analysis_(analysis),
        model_(model),
        result_(result),
        limits_(limits),
        posed_(analysis.classes[analysis.best]),
        scene_(scene) {}

  void working_sets() {
    const WorkingSets& sets = analysis_.sets;
    std::vector<Index> smallest(analysis_.mesh.view().vertex_count(), none);  // of the sets that hold a vertex
    for (Index s = 0; s < sets.size(); ++s)
      for (const Index v : sets[s])
        if (smallest[v] == none || sets[s].size() < sets[smallest[v]].size()) smallest[v] = s;
    scene_.types = sets.type_names;
    for (Index type = 0; type < sets.type_names.size(); ++type) {
      std::vector<Index> all;
      for (Index v = 0; v < smallest.size(); ++v)
        if (smallest[v] != none && sets.types[smallest[v]] == type) all.push_back(v);
      scene_.all_sets.push_back({sets.type_names[type], scene_.of_sets().shown(all), all.size()});
    }
  }

  void candidates() {
    for (Index f = 0; f < model_.features.size(); ++f) {
      const Offers offers = offers_of(f);
      std::vector<bool> shown(offers.constructed.size(), false);
      for (Index r = 0; r < shown.size(); ++r) shown[r] = r < limits_.candidates || named(f, r + 1);
      for (Index r = 0; r < shown.size(); ++r)
        if (shown[r]) add_candidate(f, r + 1, offers);
    }
  }

  void found() {
    for (Index f = 0; f < result_.features.size(); ++f) {
      const FeatureReport& report = result_.features[f];
      if (!report.present) continue;
      std::vector<Vec3> region;
      for (const Index s : report.working_sets)
        for (const Index v : analysis_.sets[s]) region.push_back(analysis_.mesh.view().positions[v]);
      const FittedShape& shape = report.shape;
      scene_.found.push_back({report.name, draw_shape(shape.parameters, region, shape.outline, shape.outline_closed),
                              posed_.answer.values[*variable_of(f)]});
    }
  }

 private:
  struct Offers {
    std::optional<Index> variable;
    std::vector<Index> constructed;  // by rank - 1
  };

  std::optional<Index> variable_of(Index feature) const {
    const auto at = std::find(posed_.features.begin(), posed_.features.end(), feature);
    if (at == posed_.features.end()) return std::nullopt;
    return static_cast<Index>(at - posed_.features.begin());
  }

  /// What the labeler could choose; of a feature that the class does not have, what was constructed.
  Offers offers_of(Index feature) const {
    const std::optional<Index> v = variable_of(feature);
    return {v, v ? posed_.problem.variables[*v].candidates
                 : analysis_.features.of_feature[analysis_.origin(feature)].constructed};
  }

  bool named(Index feature, Index rank) const {
    const std::optional<Index> v = variable_of(feature);
    return v && (posed_.answer.values[*v] == rank ||
                 std::any_of(posed_.outcome.labelings.begin(), posed_.outcome.labelings.end(),
                             [&](const Labeling& labeling) { return labeling.values[*v] == rank; }));
  }

  void add_candidate(Index feature, Index rank, const Offers& offers) {
    const Index constructed = offers.constructed[rank - 1];
    const ConstructedFeature& made = analysis_.features.all[constructed];
    const FeatureCandidates& all = analysis_.features.of_feature[analysis_.origin(feature)];
    ShownCandidate candidate;
    candidate.feature = model_.features[feature].name;
    candidate.rank = rank;
    candidate.probability = offers.variable && !posed_.outcome.posteriors.empty()
                                ? posed_.outcome.posteriors[*offers.variable][rank]
                                : std::numeric_limits<double>::quiet_NaN();
    const auto at = std::find(all.constructed.begin(), all.constructed.end(), constructed);
    candidate.evidence = all.evidence[static_cast<std::size_t>(at - all.constructed.begin())];
    candidate.shape = made.plugin;
    candidate.parameters = made.shape.parameters;
    candidate.fit_error = made.shape.rms;
    for (const Index set : made.sets) candidate.working_sets.push_back(shown_set(set));
    candidate.drawing = draw_shape(made.shape.parameters, made.points, made.shape.outline, made.shape.outline_closed);
    scene_.candidates.push_back(std::move(candidate));
  }

  Index shown_set(Index set) {
    const auto [place, is_new] = number_.try_emplace(set, static_cast<Index>(scene_.sets.size()));
    if (is_new)
      scene_.sets.push_back({analysis_.sets.type_names[analysis_.sets.types[set]],
                             scene_.of_sets().shown(analysis_.sets[set]), analysis_.sets[set].size(),
                             analysis_.sets.saliency[set], analysis_.sets.plugin_names[analysis_.sets.plugins[set]]});
    return place->second;
  }

  const Analysis& analysis_;
  const Model& model_;
  const Result& result_;
  const SceneLimits& limits_;
  const ClassOutcome& posed_;
  Scene& scene_;
  std::map<Index, Index> number_;  // of working sets in the scene
};

void add_input(const Mesh& input, const std::vector<std::uint8_t>& labels, std::size_t limit, Scene& scene) {
  scene.input = display_mesh(input.view(), labels, limit);
  for (Index t = 0; t < scene.input.triangles.size(); ++t)
    scene.input_faces.push_back(input.face_origin()[scene.input.faces.empty() ? t : scene.input.faces[t]]);
}

void add_marks(const Truth* truth, Scene& scene) {
  if (!truth) return;
  scene.has_truth = true;
  scene.truth = truth->document;
  for (const TruthFeature& feature : truth->features) scene.marks.emplace_back(feature.name, feature.points);
}

}  // namespace

std::string scene_title(const std::filesystem::path& mesh, const std::string& model) {
  return mesh.filename().string() + " · " + model;
}

std::vector<std::uint8_t> labels_of(const Result& result, Index triangles) {
  std::vector<std::uint8_t> labels(triangles, 0);
  for (std::size_t f = 0; f < result.features.size() && f < most_labels; ++f)
    for (const Index t : result.features[f].triangles) labels[t] = static_cast<std::uint8_t>(f + 1);
  return labels;
}

Scene make_scene(const Analysis& analysis, const Model& model, const Result& result, const Truth* truth,
                 const SceneLimits& limits) {
  const Mesh& input = *analysis.mesh.input;
  Scene scene;
  scene.title = scene_title(result.mesh_path, result.model);
  scene.result = to_json_line(result);
  scene.model = model.document;
  for (const FeatureReport& report : result.features) scene.features.push_back(report.name);
  add_input(input, labels_of(result, input.view().face_count()), limits.triangles, scene);
  const bool whole = limits.candidates > 0;
  if (whole && (analysis.mesh.filtered || analysis.mesh.coarse))
    scene.normalised = display_mesh(analysis.mesh.view(), {}, limits.triangles);
  SceneMaker maker(analysis, analysis.written_out(model), result, limits, scene);
  if (whole) {
    maker.working_sets();
    maker.candidates();
  }
  maker.found();
  add_marks(truth, scene);
  return scene;
}

Scene make_scene(const Mesh& input, const std::vector<std::uint8_t>& labels, std::string result_json,
                 std::vector<FoundFeature> found, std::vector<std::string> features, const Truth* truth,
                 const SceneLimits& limits) {
  Scene scene;
  scene.result = std::move(result_json);
  scene.features = std::move(features);
  scene.found = std::move(found);
  add_input(input, labels, limits.triangles, scene);
  add_marks(truth, scene);
  return scene;
}

}  // namespace toposcope
