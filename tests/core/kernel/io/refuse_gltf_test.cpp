// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "core/kernel/io/gltf_files.h"

namespace toposcope {
namespace {

using test::GltfFile, test::Json, test::refusal, test::says, test::square_gltf;

/// Refused after the change, and the reason.
template <class Change>
std::string refused(Change change) {
  GltfFile file = square_gltf();
  file.scene({{{"mesh", 0}}}, {0});
  file.glb();
  change(file.json);
  return refusal(test::glb(file.json.dump(), file.binary), ".glb");
}

TEST(RefuseGltf, CompressionNamesItsExtension) {
  EXPECT_TRUE(says(refused([](Json& j) {
                     j["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
                     j["accessors"][0].erase("bufferView");
                   }),
                   "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression"));
  EXPECT_TRUE(
      says(refused([](Json& j) { j["extensionsRequired"] = {"ACME_mesh_compression"}; }), "ACME_mesh_compression"));
  EXPECT_TRUE(
      says(refused([](Json& j) { j["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = Json::object(); }),
           "bufferViews[0].extensions.EXT_meshopt_compression has no 'buffer'"));
  EXPECT_TRUE(says(refused([](Json& j) { j["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = Json::object(); }),
                   "EXT_mesh_gpu_instancing"));
}

TEST(RefuseGltf, RangesBeyondTheData) {
  const auto number = [](const char* list, int item, const char* key, Json value) {
    return refused([&](Json& j) { j[list][item][key] = value; });
  };
  const double huge = 281474976710655.0;  // 2^48 - 1
  for (Json value : {Json(7), Json(huge), Json(1e300), Json(-1), Json(0.5), Json("4"), Json(nullptr), Json(~0ULL)}) {
    EXPECT_NE(number("accessors", 0, "count", value), "") << value;
    EXPECT_NE(number("accessors", 1, "componentType", value), "") << value;
    EXPECT_NE(number("accessors", 0, "bufferView", value), "") << value;
    EXPECT_NE(number("bufferViews", 0, "buffer", value), "") << value;
    EXPECT_NE(number("bufferViews", 0, "byteLength", value), "") << value;
    EXPECT_NE(number("bufferViews", 0, "byteStride", value), "") << value;
    EXPECT_NE(number("buffers", 0, "byteLength", value), "") << value;
    EXPECT_NE(number("nodes", 0, "mesh", value), "") << value;
  }
  for (Json value : {Json(49), Json(huge), Json(-1)}) {
    EXPECT_NE(number("accessors", 0, "byteOffset", value), "") << value;
    EXPECT_NE(number("bufferViews", 0, "byteOffset", value), "") << value;
  }
  EXPECT_TRUE(says(number("accessors", 0, "type", "VEC2"), "accessors[0] must have the type VEC3"));
  EXPECT_TRUE(says(number("buffers", 0, "byteLength", 99), "buffers[0] announces 99 bytes but holds 60"));
  EXPECT_TRUE(says(number("accessors", 0, "count", 3), "meshes[0].primitives[0] refers to vertex 3"));
}

TEST(RefuseGltf, NumbersThatAreNone) {
  GltfFile file;
  file.mesh(file.positions({0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 0, 1, 0}), -1);
  EXPECT_TRUE(says(refusal(file.glb(), ".glb"), "mesh.glb: vertex 1 (from 0) has a coordinate that is not a finite"));
  EXPECT_TRUE(says(refused([](Json& j) {
                     j["nodes"][0]["scale"] = j["nodes"][0]["translation"] = {1e308, 1e308, 1e308};
                   }),
                   "vertex 1 (from 0) has a coordinate that is not a finite number"));
  EXPECT_TRUE(says(refused([](Json& j) { j["nodes"][0]["matrix"] = {1, 2}; }), "nodes[0].matrix must have 16"));
  EXPECT_TRUE(says(refusal(R"({"asset":{"version":"2.0"},"scene":1e999})", ".gltf"), "beyond the range"));
}

TEST(RefuseGltf, RingsAndDepthAndInstancesWithoutEnd) {
  EXPECT_TRUE(
      says(refused([](Json& j) { j["nodes"][0]["children"] = {0}; }), "nodes[0].children names node 0 a second"));
  EXPECT_TRUE(says(refused([](Json& j) {
                     j["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}};
                   }),
                   "node 1 a second time"));
  EXPECT_TRUE(says(refused([](Json& j) { j["nodes"][0]["children"] = {4}; }), "node 4, which does not exist"));

  // A chain of nodes as long as the file allows is read: no recursion.
  GltfFile chain = square_gltf();
  Json nodes = {{{"mesh", 0}}};
  for (int i = 1; i < 30000; ++i) nodes.push_back({{"children", {i - 1}}});
  chain.scene(nodes, {nodes.size() - 1});
  EXPECT_EQ(refusal(chain.glb(), ".glb"), "");

  // One mesh of a hundred primitives, many times: 704 vertices and corners each.
  GltfFile instances = square_gltf();
  const Json primitive = instances.json["meshes"][0]["primitives"][0];
  for (int i = 1; i < 100; ++i) instances.json["meshes"][0]["primitives"].push_back(primitive);
  const auto repeated = [&](int times) {
    Json copies = Json::array(), roots = Json::array();
    for (int i = 0; i < times; ++i) {
      copies.push_back({{"mesh", 0}});
      roots.push_back(i);
    }
    instances.scene(copies, roots);
    return refusal(instances.glb(), ".glb");
  };
  EXPECT_EQ(repeated(1000), "");
  EXPECT_TRUE(says(repeated(2000), "meshes[0].primitives[") && says(repeated(2000), "out of proportion to the file"));
}

TEST(RefuseGltf, DamagedContainersAndJson) {
  EXPECT_TRUE(says(refusal("{", ".gltf"), "mesh.gltf:1: the JSON is damaged"));
  EXPECT_TRUE(says(refusal("{\n\"asset\": }", ".gltf"), "mesh.gltf:2: the JSON is damaged"));
  EXPECT_TRUE(says(refusal("[]", ".gltf"), "not an object"));
  EXPECT_TRUE(says(refusal("{}", ".gltf"), "has no 'asset'"));
  EXPECT_TRUE(says(refusal(R"({"asset":{"version":"1.0"}})", ".gltf"), "export version 2.0"));
  EXPECT_TRUE(says(refusal(R"({"asset":{"version":"2.0"}})", ".gltf"), "no vertex"));
  EXPECT_TRUE(says(refusal("glTF\1\0\0\0", ".glb"), "within its header"));
  for (char open : {'[', '{'}) {
    std::string deep = R"({"asset":)";
    for (int i = 0; i < 200000; ++i) deep += open == '[' ? "[" : "{\"a\":";
    EXPECT_TRUE(says(refusal(deep, ".gltf"), "nested more than 64 deep"));
  }
  GltfFile file = square_gltf();
  const std::string whole = file.glb();
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_NE(refusal(whole.substr(0, size), ".glb"), "") << size;
  std::string old = whole;
  old[4] = 1;
  EXPECT_TRUE(says(refusal(old, ".glb"), "byte 4: glTF of version 1"));
}

}  // namespace
}  // namespace toposcope
