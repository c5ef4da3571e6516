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
      mesh.file = each;
      mesh.truth = truth_beside(entry["truth"] ? beside(entry["truth"].Scalar()) / each.filename() : each);
      if (entry["class"]) mesh.class_name = entry["class"].Scalar();
      mesh.seed = seed_;
      dataset_.meshes.push_back(std::move(mesh));
    }
  }

  void objects(const YAML::Node& entry) {
    std::vector<std::string> kinds;
    if (entry["kind"].IsSequence())
      for (const YAML::Node& kind : entry["kind"]) kinds.push_back(kind.Scalar());
    else
      kinds.push_back(entry["kind"].Scalar());
    DatasetMesh common;
    if (entry["preset"]) common.preset = entry["preset"].Scalar();
    if (entry["noise"]) common.noise = entry["noise"].as<double>();
    if (entry["view"]) common.view = entry["view"].as<Index>();
    common.scan = entry["scan"] && entry["scan"].as<bool>();
    common.decimated = entry["decimated"] && entry["decimated"].as<bool>();
    if (common.scan && common.decimated)
      errors_.add(location_of(entry["decimated"], file_.string()),
                  "'scan' and 'decimated' exclude each other: leave one out");
    if (entry["set"])
      for (const auto& parameter : entry["set"])
        common.parameters[parameter.first.Scalar()] = parameter_value(parameter.second);
    common.random = entry["random"].IsDefined();
    const auto draws = common.random ? entry["random"].as<std::size_t>() : kinds.size();
    for (std::size_t draw = 0; draw < draws; ++draw)
      for (const YAML::Node& faces : entry["faces"]) {
        DatasetMesh mesh = common;
        mesh.kind = kinds[draw % kinds.size()];
        mesh.faces = faces.as<Index>();
        mesh.variant = in_thousands(mesh.faces);
        mesh.object = entry["name"] ? entry["name"].Scalar() : mesh.preset.empty() ? mesh.kind : mesh.preset;
        mesh.seed = seed_ + draw;
        mesh.name = mesh.object + (common.random ? " " + std::to_string(mesh.seed) : "") + " " + mesh.variant;
        dataset_.meshes.push_back(std::move(mesh));
      }
  }

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
