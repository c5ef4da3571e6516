// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>
#include <set>

#include "core/problem/global_function_cases.h"
#include "corpus.h"
#include "formats/problem_formats.h"
#include "fuzz_catalog.h"
#include "io/mesh_io.h"
#include "lock/run_lock.h"
#include "mesh/content_hash.h"
#include "sample/sample.h"
#include "scene/scene.h"
#include "small_mesh.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::fuzz {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// All YAML files of these folders.
void add_files(Corpus corpus, const fs::path& source, std::initializer_list<const char*> folders) {
  for (const char* folder : folders)
    for (const auto& entry : fs::directory_iterator(source / folder))
      if (entry.path().extension() == ".yaml") corpus.add(content_of(entry.path()));
}

/// The keys and fixed values that a schema knows.
void collect_words(const Json& schema, std::set<std::string>& words) {
  if (schema.is_object())
    for (const auto& [key, value] : schema.items()) {
      if (key == "properties")
        for (const auto& property : value.items()) words.insert(property.key());
      if (key == "enum")
        for (const Json& each : value)
          if (each.is_string()) words.insert(each.get<std::string>());
      collect_words(value, words);
    }
  else if (schema.is_array())
    for (const Json& each : schema) collect_words(each, words);
}

void add_words(const fs::path& dictionary, const fs::path& schema, std::set<std::string> words = {}) {
  if (!schema.empty()) collect_words(Json::parse(content_of(schema)), words);
  std::ofstream file(dictionary);
  for (const std::string& word : words) file << Json(word).dump() << '\n';
}

const Json every_shape = Json::parse(R"({
  "circle": {"center": [0, 0, 1], "normal": [0, 0, 1], "radius": 0.5},
  "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]},
  "line-group": {"endpoints": [[0, 0, 0], [1, 0, 0], [1, 1, 0]], "closed": true},
  "sphere": {"center": [0, 0, 0], "radius": 1},
  "cylinder": {"point": [0, 0, 0], "axis": [0, 0, 1], "radius": 0.7},
  "cone": {"apex": [0, 0, 1], "axis": [0, 0, -1], "half_angle": 0.5},
  "torus": {"center": [0, 0, 0], "axis": [0, 0, 1], "major_radius": 0.7, "minor_radius": 0.2}})");

std::string result_text(const std::string& hash) {
  Json result = {{"schema", "toposcope.result/1"},
                 {"mesh", {{"path", "mesh.off"}, {"sha256", hash}}},
                 {"model", "cup"},
                 {"features", Json::object()}};
  for (const auto& [shape, parameters] : every_shape.items())
    result["features"][shape] = {
        {"present", true}, {"probability", 0.9}, {"shape", shape}, {"parameters", parameters}, {"faces", {0, 1, 2, 5}}};
  result["features"]["none"] = {{"present", false}, {"probability_missing", nullptr}, {"reason", "not there"}};
  return result.dump(1);
}

Scene scene_of(const Mesh& mesh, const std::string& result) {
  std::vector<std::uint8_t> labels(mesh.view().face_count(), 0);
  labels[0] = 1;
  Drawing drawing;
  drawing.lines = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}};
  drawing.patches = {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}}};
  Truth truth;
  truth.class_name = "cup";
  truth.features.emplace_back().name = "circle";
  truth.features[0].points = {{0, 0, 1}, {1, 0, 0}};
  truth.document = R"({"class": "cup", "features": {}})";
  Scene scene = make_scene(mesh, labels, result, {{"circle", drawing, 1}}, {"circle", "plane"}, &truth);
  scene.title = "mesh.off";
  scene.all_sets = {{"convex", {0, 1, 2}, 3, 1}, {"concave", {3}, 1, 0.5}};
  scene.types = {"convex", "concave"};
  scene.sets = {{"convex", {0, 1, 2}, 3, 1}};
  ShownCandidate& candidate = scene.candidates.emplace_back();
  candidate.feature = "circle";
  candidate.rank = 1;
  candidate.shape = "circle";
  candidate.parameters = {{"center", 3, {0, 0, 1}}, {"radius", 1, {0.5}}};
  candidate.working_sets = {0};
  candidate.drawing = drawing;
  scene.model =
      R"({"name": "cup", "associations": [{"from": "a", "up": "b"}], "features": {"circle": {"realises": "a"}}})";
  return scene;
}

void add_results(const fs::path& folder) {
  const Mesh mesh(read_soup(small_mesh, "mesh.off"), "mesh.off");
  const std::string result = result_text(content_hash(mesh));
  Corpus(folder / "result").add(result);
  Corpus scenes(folder / "scene");
  Scene scene = scene_of(mesh, result);
  scenes.add(to_json(scene, "seed"));
  scene.normalised = scene.input;
  for (Vec3& p : scene.input.positions) p *= 1e30;
  scenes.add(to_json(scene, "seed"));
}

void add_truths(Corpus corpus) {
  Sample sample;
  sample.truth.class_name = "cup";
  TruthFeature& rim = sample.truth.features.emplace_back();
  rim.name = "rim";
  rim.shape = "circle";
  rim.parameters = {{"center", {0, 0, 1}}, {"normal", {0, 0, 2}}, {"band", {5, 3}}, {"closed", {1}}};
  rim.points = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  rim.vertices = {0, 7, 2};
  rim.groups = {{"upper", {0, 1}, Vec3::Zero()}, {"lower", {2}, Vec3::UnitX()}};
  sample.truth.features.emplace_back().name = "bottom";
  corpus.add(truth_json(sample, "cup.off"));
  corpus.add(
      R"({"mesh": "cup.off", "class": "cup", "frame": {"mean_edge": 0.5, "bbox_diagonal": 20}, "features": {
      "rim": {"points": [[1, 2, 3], [4, 5, 6]], "parameters": {"center": [0, 0, 1], "normal": [0, 0, 2], "band": [5, 3]}},
      "bottom": {"points": []},
      "handleCon": {"shape": "line-group", "points": [[0, 0, 0], [9, 9, 9]], "vertices": [7, 4],
                    "groups": [{"name": "upper", "points": [[0, 0, 0]], "vertices": [7], "centroid": [9, 9, 8]}]}}})");
}

void add_locks(Corpus corpus) {
  RunLock lock;
  lock.program = {"0.1.0", {"toposcope", "00ff"}};
  lock.pipeline = "default";
  lock.resolution = {{"faces", "40000"}};
  lock.probability = {{"clutter", "0.5"}};
  lock.model = {"cup.yaml", "11"};
  lock.plugins = {{"shapes", "circle", "1.0.0", {"circle.so", "22"}, {{"method", "robust"}}, {{"toulbar2", "33"}}}};
  lock.meshes = {{{"cup.gltf", "44"}, {{"cup.bin", "55"}}}};
  corpus.add(to_json(lock));
}

ProblemFile small_problem() {
  ProblemFile file;
  LabelingProblem& problem = file.problem;
  problem.name = "p";
  problem.constant = 0.5;
  problem.variables = {{"rim", 0.9, {0, 1}, {0.25, -1, 2}, true, {}},
                       {"edge", 1, {}, {1, forbidden}, false, {"u", "v"}}};
  problem.constraints = {{"r1", {0, 1}, {0, 0, 1, forbidden, -0.5, 2}, {0, 0, 1, 2, 0.5F, 1}}};
  problem.candidate_count = 2;
  problem.conflict_bits = {3, 3};
  file.top = 20.5;
  return file;
}

void add_problems(const fs::path& folder) {
  const ProblemFile problem = small_problem();
  Corpus(folder / "problem").add(problem_json(problem));
  Corpus cfn(folder / "cfn"), wcsp(folder / "wcsp"), uai(folder / "uai");
  cfn.add(write_cfn(problem.problem, problem.top).text);
  wcsp.add(write_wcsp(problem.problem, problem.top).text);
  uai.add(write_uai(problem.problem).text);
  for (const test::GlobalFunctionCase& each : test::global_function_cases) {
    wcsp.add(each.file);
    cfn.add(write_cfn(read_wcsp("seed", each.file).problem).text);
  }
  wcsp.add("p 3 4 3 10\n4 4 4\n-2 0 1 0 0\n2 1 2 0 -1\n2 0 2 0 -1\n");
  cfn.add(R"({
# a comment
"problem": {"name": "p", "mustbe": "<20.5"},  // another
"variables": {"a": ["u", "v"], b: 3, 2, "c": -4},
"functions": {
  "f1": {"scope": ["c", "b"], "costs": "f2"},
  "f2": {scope: [3 1], "defaultcost": 1.5, costs: [2 0 -4 3 2 7.25]},
  {"scope": [a, b], "defaultcost": 0.5, "costs": ["v", 2, 3]},
  constant {scope [] costs [2]}
  g: {scope: [b c] type: "wsum" params: {metric: lin cost: 2 comparator: "<=" to: 3}}
}})");
  uai.add("MARKOV\n2\n2 3\n2\n1 0\n2 0 1\n\n2 0.5 0.5\n6 1 0 1e-3 2 0.25 1\n");
  uai.add("BAYES\n1\n2\n1\n1 0\n2\n0.2 0.8\n");
}

void add_expressions(Corpus corpus) {
  for (const char* text :
       {"bb(w).c/2 < r < bb(O).a", "bb(O).a/20 + min(bb(w).b, 2*bb(O).c)*pi", "-(1 - 2.5e-3) * max(1, 2)", "r <= 90",
        "rim.radius / distance(rim, wall) < 2", "angle(rim, wall) + 2 * edge.length_2", "along(rim, wall, edge)",
        "across(rim, wall, edge) * rim.radius", "0.5 < half_angle", "sqrt(wall.area)"})
    corpus.add(text);
}

}  // namespace

void add_documents(const fs::path& folder, const fs::path& source) {
  add_files(Corpus(folder / "model"), source, {"models", "models/neal-1999", "models/templates", "examples/models"});
  add_files(Corpus(folder / "pipeline"), source, {"pipelines", "examples/pipelines"});
  add_files(Corpus(folder / "dataset"), source, {"datasets"});
  Corpus manifests(folder / "manifest");
  for (const PluginKind kind : plugin_kinds)
    for (const PluginManifest* each : catalog().all(kind)) manifests.add(manifest_to_json(*each));
  add_results(folder);
  add_truths(Corpus(folder / "truth"));
  add_locks(Corpus(folder / "lock"));
  add_problems(folder);
  add_expressions(Corpus(folder / "expression"));
  for (const char* kind : {"model", "pipeline", "dataset", "truth", "scene", "result", "lock", "problem"})
    add_words(folder / (std::string(kind) + ".dict"), source / "schemas" / (std::string(kind) + ".schema.json"));
  add_words(folder / "manifest.dict", source / "schemas/plugin.schema.json");
  add_words(folder / "expression.dict", {},
            {"min(", "max(", "bb(O).a", "bb(w).b", "pi", "rim.radius", "distance(", "along(", "across(", "angle(",
             "rim", "wall", "edge", "<=", "1e308"});
}

}  // namespace toposcope::fuzz
