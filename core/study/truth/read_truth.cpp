// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/text_file.h"
#include "truth/truth.h"

namespace toposcope {
namespace {

using Json = nlohmann::json;

/// Reads members of a document; errors name the file and the member as a JSON pointer.
class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw UsageError(file_ + ": " + (place.empty() ? "" : place + ": ") + what + " (schemas/truth.schema.json)");
  }

  Truth read(const Json& root) const {
    if (!root.is_object()) fail("", "a truth file holds a JSON object");
    Truth truth;
    if (root.contains("class") && root["class"].is_string()) truth.class_name = root["class"];
    if (!root.contains("features") || !root["features"].is_object())
      fail("/features", "expected an object of features by name");
    for (const auto& [name, node] : root["features"].items())
      truth.features.push_back(feature(name, node, "/features/" + name));
    if (root.contains("frame")) {
      const Json& frame = root["frame"];
      if (frame.contains("mean_edge")) truth.mean_edge = length(frame["mean_edge"], "/frame/mean_edge");
      if (frame.contains("bbox_diagonal")) truth.diagonal = length(frame["bbox_diagonal"], "/frame/bbox_diagonal");
    }
    return truth;
  }

 private:
  double number(const Json& node, const std::string& place) const {
    if (!node.is_number() || !std::isfinite(node.get<double>())) fail(place, "expected a number");
    return node.get<double>();
  }

  double length(const Json& node, const std::string& place) const {
    const double value = number(node, place);
    if (!(value > 0)) fail(place, "expected a length above 0");
    return value;
  }

  Vec3 triple(const Json& node, const std::string& place) const {
    if (!node.is_array() || node.size() != 3) fail(place, "expected three numbers");
    return {number(node[0], place + "/0"), number(node[1], place + "/1"), number(node[2], place + "/2")};
  }

  std::vector<Vec3> triples(const Json& node, const std::string& place) const {
    if (!node.is_array()) fail(place, "expected a list of points");
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < node.size(); ++i) points.push_back(triple(node[i], place + "/" + std::to_string(i)));
    return points;
  }

  TruthFeature feature(const std::string& name, const Json& node, const std::string& place) const {
    if (!node.is_object() || (!node.contains("points") && !node.contains("groups")))
      fail(place, "expected an object with 'points' or 'groups'");
    TruthFeature feature;
    feature.name = name;
    if (node.contains("points")) feature.points = triples(node["points"], place + "/points");
    if (node.contains("groups")) {
      if (!node["groups"].is_array()) fail(place + "/groups", "expected a list");
      for (std::size_t i = 0; i < node["groups"].size(); ++i)
        feature.groups.push_back(group(node["groups"][i], place + "/groups/" + std::to_string(i)));
    }
    if (node.contains("parameters") && node["parameters"].contains("band"))
      feature.band = band(node["parameters"], place + "/parameters");
    return feature;
  }

  TruthGroup group(const Json& node, const std::string& place) const {
    if (!node.is_object() || !node.contains("points")) fail(place, "expected an object with 'points'");
    TruthGroup group;
    if (node.contains("name") && node["name"].is_string()) group.name = node["name"];
    group.points = triples(node["points"], place + "/points");
    if (group.points.empty()) fail(place + "/points", "a group has points; leave out the group instead");
    for (const Vec3& p : group.points) group.centroid += p / static_cast<double>(group.points.size());
    if (node.contains("centroid")) group.centroid = triple(node["centroid"], place + "/centroid");
    return group;
  }

  TruthBand band(const Json& parameters, const std::string& place) const {
    const Json& radii = parameters["band"];
    if (!radii.is_array() || radii.size() != 2 || !parameters.contains("center") || !parameters.contains("normal"))
      fail(place, "'band' is two radii, beside 'center' and 'normal'");
    TruthBand band{triple(parameters["center"], place + "/center"), triple(parameters["normal"], place + "/normal"),
                   length(radii[0], place + "/band/0"), length(radii[1], place + "/band/1")};
    if (!(band.normal.norm() > 0)) fail(place + "/normal", "expected a direction");
    band.normal.normalize();
    if (band.inner > band.outer) std::swap(band.inner, band.outer);
    return band;
  }

  std::string file_;
};

}  // namespace

const TruthFeature* Truth::find(std::string_view name) const {
  for (const TruthFeature& feature : features)
    if (feature.name == name) return &feature;
  return nullptr;
}

Truth read_truth(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, "truth file");
  const Reader reader(path.string());
  try {
    Json root = Json::parse(text);
    Truth truth = reader.read(root);
    root.erase("parts");
    truth.document = root.dump();
    return truth;
  } catch (const Json::exception& error) {
    reader.fail("", std::string("is no JSON: ") + error.what());
  }
}

std::filesystem::path truth_beside(const std::filesystem::path& mesh) {
  std::filesystem::path path = mesh;
  path.replace_extension(".truth.json");
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) ? path : std::filesystem::path();
}

}  // namespace toposcope
