// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "base/errors.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "truth/truth.h"

namespace toposcope {
namespace {

/// Reads members of a document; errors name the file and the member as a JSON pointer.
class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw UsageError(file_ + ": " + (place.empty() ? "" : place + ": ") + what + " (schemas/truth.schema.json)");
  }

  Truth read(const nlohmann::json& root) const {
    if (!root.is_object()) fail("", "a truth file holds a JSON object");
    Truth truth;
    if (root.contains("class") && root["class"].is_string()) truth.class_name = root["class"];
    if (!root.contains("features") || !root["features"].is_object())
      fail("/features", "expected an object of features by name");
    for (const auto& [name, node] : root["features"].items())
      truth.features.push_back(feature(name, node, "/features/" + name));
    if (root.contains("frame")) {
      const nlohmann::json& frame = root["frame"];
      if (frame.contains("mean_edge")) truth.mean_edge = length(frame["mean_edge"], "/frame/mean_edge");
      if (frame.contains("bbox_diagonal")) truth.diagonal = length(frame["bbox_diagonal"], "/frame/bbox_diagonal");
    }
    return truth;
  }

 private:
  double number(const nlohmann::json& node, const std::string& place) const {
    if (!node.is_number() || !std::isfinite(node.get<double>())) fail(place, "expected a number");
    return node.get<double>();
  }

  double length(const nlohmann::json& node, const std::string& place) const {
    const double value = number(node, place);
    if (!(value > 0)) fail(place, "expected a length above 0");
    return value;
  }

  Vec3 triple(const nlohmann::json& node, const std::string& place) const {
    if (!node.is_array() || node.size() != 3) fail(place, "expected three numbers");
    return {number(node[0], place + "/0"), number(node[1], place + "/1"), number(node[2], place + "/2")};
  }

  std::vector<Vec3> triples(const nlohmann::json& node, const std::string& place) const {
    if (!node.is_array()) fail(place, "expected a list of points");
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < node.size(); ++i) points.push_back(triple(node[i], place + "/" + std::to_string(i)));
    return points;
  }

  TruthFeature feature(const std::string& name, const nlohmann::json& node, const std::string& place) const {
    if (!node.is_object() || (!node.contains("points") && !node.contains("groups")))
      fail(place, "expected an object with 'points' or 'groups'");
    TruthFeature feature;
    feature.name = name;
    if (node.contains("shape") && node["shape"].is_string()) feature.shape = node["shape"];
    read_marks(node, place, feature);
    if (node.contains("groups")) {
      if (!node["groups"].is_array()) fail(place + "/groups", "expected a list");
      // The groups hold all marks; what is listed beside them are the same points.
      if (!node["groups"].empty()) feature.points.clear(), feature.vertices.clear();
      for (std::size_t i = 0; i < node["groups"].size(); ++i)
        read_group(node["groups"][i], place + "/groups/" + std::to_string(i), feature);
    }
    if (node.contains("parameters")) read_parameters(node["parameters"], place + "/parameters", feature);
    return feature;
  }

  /// Adds a node's points and, where they are given, their vertices.
  void read_marks(const nlohmann::json& node, const std::string& place, TruthFeature& feature) const {
    if (!node.contains("points")) return;
    const std::vector<Vec3> points = triples(node["points"], place + "/points");
    feature.points.insert(feature.points.end(), points.begin(), points.end());
    if (!node.contains("vertices")) return;
    const nlohmann::json& vertices = node["vertices"];
    if (!vertices.is_array() || vertices.size() != points.size())
      fail(place + "/vertices", "expected as many vertices as points");
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (!vertices[i].is_number_unsigned())
        fail(place + "/vertices/" + std::to_string(i), "expected a vertex, from 0");
      feature.vertices.push_back(vertices[i].get<Index>());
    }
  }

  void read_group(const nlohmann::json& node, const std::string& place, TruthFeature& feature) const {
    if (!node.is_object() || !node.contains("points")) fail(place, "expected an object with 'points'");
    TruthGroup& group = feature.groups.emplace_back();
    if (node.contains("name") && node["name"].is_string()) group.name = node["name"];
    const std::size_t first = feature.points.size();
    read_marks(node, place, feature);
    const std::size_t count = feature.points.size() - first;
    if (count == 0) fail(place + "/points", "a group has points; leave out the group instead");
    for (std::size_t i = first; i < feature.points.size(); ++i) {
      group.members.push_back(static_cast<Index>(i));
      group.centroid += feature.points[i] / static_cast<double>(count);
    }
    if (node.contains("centroid")) group.centroid = triple(node["centroid"], place + "/centroid");
  }

  /// A number, a truth value, or a list of numbers or points.
  std::vector<double> parameter(const nlohmann::json& node, const std::string& place) const {
    if (node.is_boolean()) return {node.get<bool>() ? 1.0 : 0.0};
    if (!node.is_array()) return {number(node, place)};
    std::vector<double> values;
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string at = place + "/" + std::to_string(i);
      if (node[i].is_array()) {
        const Vec3 point = triple(node[i], at);
        values.insert(values.end(), point.begin(), point.end());
      } else {
        values.push_back(number(node[i], at));
      }
    }
    return values;
  }

  void read_parameters(const nlohmann::json& node, const std::string& place, TruthFeature& feature) const {
    if (!node.is_object()) fail(place, "expected an object");
    for (const auto& [name, value] : node.items())
      feature.parameters.emplace_back(name, parameter(value, place + "/" + name));
    if (node.contains("band")) check_band(node, place, feature);
  }

  /// Its normal comes out of length 1.
  void check_band(const nlohmann::json& node, const std::string& place, TruthFeature& feature) const {
    const nlohmann::json& radii = node["band"];
    if (!radii.is_array() || radii.size() != 2 || !node.contains("center") || !node.contains("normal"))
      fail(place, "'band' is two radii, beside 'center' and 'normal'");
    length(radii[0], place + "/band/0");
    length(radii[1], place + "/band/1");
    triple(node["center"], place + "/center");
    Vec3 normal = triple(node["normal"], place + "/normal");
    if (!(normal.norm() > 0)) fail(place + "/normal", "expected a direction");
    normal.normalize();
    for (auto& [name, values] : feature.parameters)
      if (name == "normal") values.assign(normal.begin(), normal.end());
  }

  std::string file_;
};

}  // namespace

Truth read_truth(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, "truth file");
  const Reader reader(path.string());
  try {
    nlohmann::json root = parse_json<nlohmann::json>(text, path.string());
    Truth truth = reader.read(root);
    root.erase("parts");
    truth.document = root.dump();
    return truth;
  } catch (const nlohmann::json::exception& error) {
    reader.fail("", json_fault(error));
  }
}

std::filesystem::path truth_beside(const std::filesystem::path& mesh) {
  std::filesystem::path path = mesh;
  path.replace_extension(".truth.json");
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) ? path : std::filesystem::path();
}

}  // namespace toposcope
