// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "core/kernel/io/mesh_files.h"

namespace toposcope::test {

using Json = nlohmann::json;

/// A GLB of these parts.
inline std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto size = [](std::size_t value) { return bytes(static_cast<std::uint32_t>(value)); };
  return "glTF" + bytes(std::uint32_t{2}) + size(28 + json.size() + binary.size()) + size(json.size()) + "JSON" + json +
         size(binary.size()) + std::string("BIN\0", 4) + binary;
}

/// Builds a glTF piece by piece: what the field calls an asset with one buffer.
struct GltfFile {
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::string binary;

  /// Numbers as an accessor of their own. \return its index
  template <class T>
  int accessor(const std::vector<T>& numbers, int type, const char* shape) {
    const std::size_t begin = binary.size(), per = shape == std::string("VEC3") ? 3 : 1;
    for (T number : numbers) binary += bytes(number);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", binary.size() - begin}});
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", type},
                                 {"count", numbers.size() / per},
                                 {"type", shape}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  int positions(const std::vector<float>& numbers) { return accessor(numbers, 5126, "VEC3"); }
  int indices(const std::vector<std::uint16_t>& numbers) { return accessor(numbers, 5123, "SCALAR"); }
  /// A mesh of one primitive; no indices where they are negative.
  void mesh(int positions_accessor, int indices_accessor, int mode = 4) {
    Json primitive = {{"attributes", {{"POSITION", positions_accessor}}}, {"mode", mode}};
    if (indices_accessor >= 0) primitive["indices"] = indices_accessor;
    json["meshes"].push_back({{"primitives", Json::array({primitive})}});
  }
  /// A scene of these nodes.
  void scene(const Json& nodes, const Json& roots) {
    json["nodes"] = nodes;
    json["scenes"] = Json::array({{{"nodes", roots}}});
  }
  std::string glb() {
    json["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    return test::glb(json.dump(), binary);
  }
};

inline std::vector<float> square_positions() {
  return {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
}

/// A square of two triangles, without a scene.
inline GltfFile square_gltf() {
  GltfFile file;
  const int positions = file.positions(square_positions());
  file.mesh(positions, file.indices({0, 1, 2, 0, 2, 3}));
  return file;
}

}  // namespace toposcope::test
