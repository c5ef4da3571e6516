// SPDX-License-Identifier: BSD-3-Clause
#include <fnmatch.h>

#include <algorithm>

#include "base/errors.h"
#include "base/schemas.h"
#include "base/text_file.h"
#include "evaluation/dataset.h"
#include "model/yaml_schema.h"
#include "truth/truth.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;

/// What is decimated had at least so many faces.
constexpr Index fine_faces = 20000;

/// "5K", "700"
std::string in_thousands(Index faces) {
  return faces % 1000 == 0 ? std::to_string(faces / 1000) + "K" : std::to_string(faces);
}

std::vector<fs::path> matching(const fs::path& pattern) {
  std::vector<fs::path> files;
  std::error_code ignored;
  // A data set named without a folder lies in the present one.
  const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored) &&
        fnmatch(pattern.filename().c_str(), entry.path().filename().c_str(), FNM_PERIOD) == 0)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Reads a document that has passed the schema.
class Reader {
 public:
  Reader(const fs::path& file, ErrorList& errors) : file_(file), errors_(errors) {}

  Dataset read(const YAML::Node& root) {
    dataset_.name = root["name"].Scalar();
    if (root["summary"]) dataset_.summary = root["summary"].Scalar();
    dataset_.model = root["model"].Scalar();
    dataset_.by_class = root["judge"] && root["judge"].Scalar() == "class";
    seed_ = root["seed"] ? root["seed"].as<std::uint64_t>() : 1;
    for (const YAML::Node& entry : root["meshes"])
      if (entry["files"])
        files(entry);
      else
        objects(entry);
    return std::move(dataset_);
  }

 private:
  fs::path beside(const std::string& relative) const { return (file_.parent_path() / relative).lexically_normal(); }

  void files(const YAML::Node& entry) {
    const fs::path pattern = beside(entry["files"].Scalar());
    const std::vector<fs::path> found = matching(pattern);
    if (found.empty()) {
      if (entry["optional"] && entry["optional"].as<bool>())
        dataset_.absent.push_back(pattern.string());
      else
        errors_.add(location_of(entry["files"], file_.string()),
                    "no file matches " + pattern.string() + "; mend the pattern, or add 'optional: true'");
    }
    for (const fs::path& each : found) {
      DatasetMesh mesh;
      mesh.name = mesh.object = each.stem().string();
      mesh.source =
          MeshFile{each, truth_beside(entry["truth"] ? beside(entry["truth"].Scalar()) / each.filename() : each),
                   entry["class"] ? entry["class"].Scalar() : ""};
      dataset_.meshes.push_back(std::move(mesh));
    }
  }

  void objects(const YAML::Node& entry) {
    std::vector<std::string> kinds;
    if (entry["kind"].IsSequence())
      for (const YAML::Node& kind : entry["kind"]) kinds.push_back(kind.Scalar());
    else
      kinds.push_back(entry["kind"].Scalar());
    const MadeMesh common = made(entry);
    const bool random = common.object.random;
    const auto draws = random ? entry["random"].as<std::size_t>() : kinds.size();
    for (std::size_t draw = 0; draw < draws; ++draw)
      for (const YAML::Node& faces : entry["faces"]) {
        MadeMesh source = common;
        SampleRequest& object = source.object;
        object.kind = kinds[draw % kinds.size()];
        object.faces = faces.as<Index>();
        object.seed = seed_ + draw;
        if (source.scan) {
          source.scan->faces = object.faces;
          source.scan->seed = object.seed;
        }
        DatasetMesh mesh;
        mesh.variant = in_thousands(object.faces);
        mesh.object = entry["name"] ? entry["name"].Scalar() : object.preset.empty() ? object.kind : object.preset;
        mesh.name = mesh.object + (random ? " " + std::to_string(object.seed) : "") + " " + mesh.variant;
        if (is_set(entry["decimated"])) {
          source.decimate_to = object.faces;
          object.faces = std::max(fine_faces, object.faces);
        }
        mesh.source = std::move(source);
        dataset_.meshes.push_back(std::move(mesh));
      }
  }

  /// What all objects of an entry have in common.
  MadeMesh made(const YAML::Node& entry) {
    MadeMesh common;
    SampleRequest& object = common.object;
    if (entry["preset"]) object.preset = entry["preset"].Scalar();
    if (entry["set"])
      for (const auto& parameter : entry["set"])
        object.parameters[parameter.first.Scalar()] = parameter_value(parameter.second);
    object.random = entry["random"].IsDefined();
    if (is_set(entry["scan"])) {
      common.scan.emplace();
      common.scan->parts = false;  // features are judged, not parts
      if (entry["view"]) common.scan->seen_from = entry["view"].as<Index>();
      if (entry["noise"]) common.scan->noise_rel = entry["noise"].as<double>();
    } else if (entry["noise"]) {
      object.noise_rel = entry["noise"].as<double>();
    }
    if (common.scan && is_set(entry["decimated"]))
      errors_.add(location_of(entry["decimated"], file_.string()),
                  "'scan' and 'decimated' exclude each other: leave one out");
    return common;
  }

  static bool is_set(const YAML::Node& node) { return node && node.as<bool>(); }

  static double parameter_value(const YAML::Node& node) {
    bool truth = false;
    if (YAML::convert<bool>::decode(node, truth)) return truth ? 1 : 0;
    return node.as<double>();
  }

  fs::path file_;
  ErrorList& errors_;
  Dataset dataset_;
  std::uint64_t seed_ = 1;
};

}  // namespace

Dataset read_dataset(const fs::path& path) {
  const YAML::Node root = parse_yaml(read_text_file(path, "data set"), path.string());
  ErrorList errors;
  check_schema(root, dataset_schema(), path.string(), errors);
  errors.throw_if_any();
  Dataset dataset = Reader(path, errors).read(root);
  errors.throw_if_any();
  return dataset;
}

}  // namespace toposcope
