// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "export/export.h"
#include "result/palette.h"
#include "toposcope/geometry/lines.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t curve_points = 48;  // Slicer draws a smooth curve through them

Json point_json(const Vec3& p, const std::string& label) {
  return {{"label", label}, {"position", {p.x(), p.y(), p.z()}}, {"positionStatus", "defined"}, {"locked", true}};
}

/// \param feature  its number, for the colour
Json markup(const char* type, const std::string& name, std::size_t feature) {
  const Rgb rgb = feature_color(feature);
  const Json color = {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
  return {{"type", type},
          {"coordinateSystem", "LPS"},
          {"name", name},
          {"locked", true},
          {"controlPoints", Json::array()},
          {"display", {{"visibility", true}, {"color", color}, {"selectedColor", color}}}};
}

double length_of(const std::vector<Vec3>& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

void add_line(const std::vector<Vec3>& line, const std::string& name, std::size_t feature, Json& markups) {
  if (line.size() > 3 && line.front() == line.back()) {
    Json curve = markup("ClosedCurve", name, feature);
    std::vector<Vec3> points = resample(line, length_of(line) / curve_points);
    points.pop_back();  // the first again
    for (const Vec3& p : points) curve["controlPoints"].push_back(point_json(p, ""));
    markups.push_back(std::move(curve));
    return;
  }
  for (std::size_t i = 1; i < line.size(); ++i) {
    Json segment = markup("Line", line.size() == 2 ? name : name + " " + std::to_string(i), feature);
    segment["controlPoints"] = {point_json(line[i - 1], name), point_json(line[i], name)};
    markups.push_back(std::move(segment));
  }
}

/// Where a feature's name stands.
std::optional<Vec3> middle(const Drawing& drawing) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const std::vector<Vec3>& line : drawing.lines) {
    const std::size_t closed = line.size() > 1 && line.front() == line.back() ? 1 : 0;
    for (std::size_t i = closed; i < line.size(); ++i) sum += line[i], ++count;
  }
  return count > 0 ? std::optional<Vec3>(sum / count) : std::nullopt;
}

}  // namespace

std::string to_slicer_markups(const LabelledMesh& labelled) {
  Json root;
  root["@schema"] =
      "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
      "markups-schema-v1.0.3.json#";
  root["markups"] = Json::array();
  Json names = markup("Fiducial", labelled.result.model, 0);
  for (const FoundFeature& found : labelled.found) {
    const std::size_t feature = labelled.number_of(found.feature);
    for (std::size_t i = 0; i < found.drawing.lines.size(); ++i)
      add_line(found.drawing.lines[i],
               found.drawing.lines.size() == 1 ? found.feature : found.feature + " " + std::to_string(i + 1), feature,
               root["markups"]);
    if (const std::optional<Vec3> at = middle(found.drawing))
      names["controlPoints"].push_back(point_json(*at, found.feature));
  }
  root["markups"].push_back(std::move(names));
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace toposcope
