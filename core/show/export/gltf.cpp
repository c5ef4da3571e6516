// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "export/export.h"
#include "picture/layer.h"
#include "result/palette.h"
#include "result/shape_json.h"
#include "scene/local_frame.h"

namespace toposcope {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

using Json = nlohmann::ordered_json;

// Numbers of the standard.
constexpr int floats = 5126, unsigned_ints = 5125, array_buffer = 34962, element_buffer = 34963;
enum Mode { points = 0, line_strip = 3, triangles = 4 };

/// Gathers a document and its one buffer.
class Document {
 public:
  Document(const std::string& program, const LocalFrame& frame) : frame_(frame) {
    root["asset"] = {{"version", "2.0"}, {"generator", program}};
    root["scene"] = 0;
    root["scenes"] = {{{"nodes", Json::array()}}};
    for (const char* list : {"nodes", "meshes", "materials", "accessors", "bufferViews"}) root[list] = Json::array();
  }

  int add(const char* list, Json object) {
    root[list].push_back(std::move(object));
    return static_cast<int>(root[list].size()) - 1;
  }

  int positions(std::vector<Vec3> list) {
    for (Vec3& p : list) p = frame_.to_local(p);
    return vectors(list, true);
  }

  int vectors(const std::vector<Vec3>& list, bool bounds) {
    std::vector<std::array<float, 3>> values;
    std::array<float, 3> low{}, high{};
    for (const Vec3& p : list) {
      values.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
      if (values.size() == 1) low = high = values[0];
      for (std::size_t k = 0; k < 3; ++k)
        low[k] = std::min(low[k], values.back()[k]), high[k] = std::max(high[k], values.back()[k]);
    }
    Json accessor = {{"bufferView", view(values.data(), values.size() * 12, array_buffer)},
                     {"componentType", floats},
                     {"count", values.size()},
                     {"type", "VEC3"}};
    if (bounds) accessor["min"] = low, accessor["max"] = high;
    return add("accessors", std::move(accessor));
  }

  int indices(const std::vector<Triangle>& list) {
    return add("accessors", {{"bufferView", view(list.data(), list.size() * sizeof(Triangle), element_buffer)},
                             {"componentType", unsigned_ints},
                             {"count", 3 * list.size()},
                             {"type", "SCALAR"}});
  }

  /// \param opacity  1: opaque
  int material(const std::string& name, const Rgb& color, double opacity) {
    const Eigen::Vector3f light = to_linear(color);
    Json object = {{"name", name},
                   {"doubleSided", true},
                   {"pbrMetallicRoughness",
                    {{"baseColorFactor", {light[0], light[1], light[2], opacity}},
                     {"metallicFactor", 0},
                     {"roughnessFactor", 0.7}}}};
    if (opacity < 1) object["alphaMode"] = "BLEND";
    return add("materials", std::move(object));
  }

  std::string file() {
    root["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    const auto number = [&](std::size_t n) {
      for (int k = 0; k < 4; ++k) file += static_cast<char>(n >> (8 * k) & 255);
    };
    number(2);
    number(12 + 8 + json.size() + 8 + bytes_.size());
    number(json.size());
    file += "JSON" + json;
    number(bytes_.size());
    file += std::string("BIN\0", 4);
    return file + bytes_;
  }

  Json root;

 private:
  int view(const void* data, std::size_t size, int target) {
    const std::size_t offset = bytes_.size();
    bytes_.append(static_cast<const char*>(data), size);
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", target}});
  }

  LocalFrame frame_;
  std::string bytes_;
};

/// The triangles of one label with only their vertices.
struct Part {
  std::vector<Vec3> positions, normals;
  std::vector<Triangle> triangles;
};

Part part_of(const MeshView& mesh, const std::vector<std::uint8_t>& labels, std::uint8_t label,
             const std::vector<Vec3>& normals) {
  Part part;
  std::unordered_map<Index, Index> number;
  for (Index t = 0; t < mesh.face_count(); ++t) {
    if (labels[t] != label) continue;
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh.triangles[t][k];
      const auto [place, is_new] = number.try_emplace(v, static_cast<Index>(part.positions.size()));
      if (is_new) part.positions.push_back(mesh.positions[v]), part.normals.push_back(normals[v]);
      triangle[k] = place->second;
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

/// Unit length, of the whole mesh, so that no seam is seen where parts meet.
std::vector<Vec3> vertex_normals(const MeshView& mesh) {
  std::vector<Vec3> normals(mesh.vertex_count(), Vec3::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 normal = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    for (const Index v : {a, b, c}) normals[v] += normal;
  }
  for (Vec3& normal : normals) normal = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
  return normals;
}

/// \return a node, or -1 where the part has no triangle
int add_part(Document& document, const std::string& name, const Part& part, int material) {
  if (part.triangles.empty()) return -1;
  const Json primitive = {
      {"attributes",
       {{"POSITION", document.positions(part.positions)}, {"NORMAL", document.vectors(part.normals, false)}}},
      {"indices", document.indices(part.triangles)},
      {"material", material},
      {"mode", triangles}};
  const int mesh = document.add("meshes", {{"name", name}, {"primitives", {primitive}}});
  return document.add("nodes", {{"name", name}, {"mesh", mesh}});
}

int add_shape(Document& document, const std::string& name, const Drawing& drawing, const Rgb& color) {
  Json primitives = Json::array();
  const int opaque = document.material(name, color, 1);
  const auto add = [&](const std::vector<Vec3>& list, Mode mode) {
    if (list.empty()) return;
    primitives.push_back(
        {{"attributes", {{"POSITION", document.positions(list)}}}, {"material", opaque}, {"mode", mode}});
  };
  for (const std::vector<Vec3>& line : drawing.lines) add(line, line_strip);
  add(drawing.points, points);
  for (const Patch& patch : drawing.patches)
    primitives.push_back({{"attributes", {{"POSITION", document.positions(patch.positions)}}},
                          {"indices", document.indices(patch.triangles)},
                          {"material", document.material(name + " patch", color, 0.4)},
                          {"mode", triangles}});
  if (primitives.empty()) return -1;
  const int mesh = document.add("meshes", {{"name", name}, {"primitives", std::move(primitives)}});
  return document.add("nodes", {{"name", name}, {"mesh", mesh}});
}

Json extras(const StoredFeature& feature) {
  return {{"probability", std::isfinite(feature.probability) ? Json(feature.probability) : Json(nullptr)},
          {"shape", feature.shape},
          {"parameters", parameters_json(feature.parameters)}};
}

}  // namespace

std::string to_gltf(const LabelledMesh& labelled, const std::string& program) {
  const MeshView& view = labelled.mesh.view();
  const LocalFrame frame = local_frame(view.positions);
  Document document(program, frame);
  const std::vector<Vec3> normals = vertex_normals(view);
  Json roots = Json::array();
  const int rest = add_part(document, "unlabelled", part_of(view, labelled.labels, 0, normals),
                            document.material("unlabelled", no_label_color, 1));
  if (rest >= 0) roots.push_back(rest);
  for (const FoundFeature& found : labelled.found) {
    const std::size_t number = labelled.number_of(found.feature);
    const Rgb color = feature_color(number);
    const int surface = add_part(document, found.feature + ".surface",
                                 part_of(view, labelled.labels, static_cast<std::uint8_t>(number + 1), normals),
                                 document.material(found.feature, color, 1));
    const int shape = add_shape(document, found.feature + ".shape", found.drawing, color);
    Json node = {{"name", found.feature}, {"extras", extras(labelled.result.features[number])}};
    for (const int child : {surface, shape})
      if (child >= 0) node["children"].push_back(child);
    roots.push_back(document.add("nodes", std::move(node)));
  }
  const std::string name = labelled.result.mesh.stem().string();
  Json node = {{"name", name}, {"children", roots}};
  if (!frame.is_world()) {
    node["translation"] = {frame.origin.x(), frame.origin.y(), frame.origin.z()};
    node["scale"] = {frame.scale, frame.scale, frame.scale};
  }
  document.root["scenes"][0] = {{"name", name}, {"nodes", {document.add("nodes", std::move(node))}}};
  return document.file();
}

}  // namespace toposcope
