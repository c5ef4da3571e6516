// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <limits>

#include "core/kernel/io/gltf_files.h"

namespace toposcope {
namespace {

using test::expect_square, test::GltfFile, test::Json, test::read_text, test::square_gltf;

TriangleSoup read(GltfFile& file) {
  return read_text(file.glb(), ".glb");
}

TEST(ReadGltf, IndicesOfEveryTypeOrNone) {
  for (int type : {5121, 5123, 5125}) {
    GltfFile file;
    const int positions = file.positions(test::square_positions());
    file.mesh(positions, type == 5121   ? file.accessor<std::uint8_t>({0, 1, 2, 0, 2, 3}, type, "SCALAR")
                         : type == 5123 ? file.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, type, "SCALAR")
                                        : file.accessor<std::uint32_t>({0, 1, 2, 0, 2, 3}, type, "SCALAR"));
    expect_square(read(file));
    expect_square(read_text(file.glb(), ".bin"));
  }
  GltfFile plain;
  plain.mesh(plain.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0}), -1);
  EXPECT_EQ(read(plain).triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(ReadGltf, StripsFansPointsAndLines) {
  GltfFile file;
  const int positions = file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  for (int mode : {0, 1, 2, 3}) file.mesh(positions, -1, mode);
  file.mesh(positions, -1, 5);
  file.mesh(positions, file.indices({0, 1, 3, 2}), 6);
  const TriangleSoup soup = read(file);
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {5, 6, 8}, {5, 8, 7}}));
  EXPECT_EQ(soup.face_origin, (std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_EQ(soup.input_faces, 5U);
}

/// Twice the signed area over the plane z = 0.
double area(const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles)
    sum += (soup.positions[b] - soup.positions[a]).cross(soup.positions[c] - soup.positions[a]).z();
  return sum;
}

TEST(ReadGltf, TransformsOfNodesAreChained) {
  GltfFile file = square_gltf();
  const double half = std::sqrt(0.5);
  file.scene({{{"children", {1}}, {"translation", {10, 0, 0}}, {"rotation", {0, 0, half, half}}},
              {{"mesh", 0}, {"scale", {2, 3, 1}}, {"translation", {0, 0, 5}}},
              {{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}}},
              {{"mesh", 0}}},
             {0, 2});
  const TriangleSoup soup = read(file);
  ASSERT_EQ(soup.positions.size(), 8U) << "the fourth node is not in the scene";
  EXPECT_TRUE(soup.positions[1].isApprox(Vec3(10, 2, 5))) << soup.positions[1].transpose();
  EXPECT_TRUE(soup.positions[3].isApprox(Vec3(7, 0, 5))) << soup.positions[3].transpose();
  EXPECT_TRUE(soup.positions[5].isApprox(Vec3(7, 9, 9)));
  EXPECT_TRUE(soup.positions[7].isApprox(Vec3(6, 8, 9)));
  EXPECT_EQ(soup.triangles[3], (Triangle{4, 6, 7}));
  EXPECT_NEAR(area(soup), 2 * (6 + 1), 1e-12);
}

TEST(ReadGltf, MirroredNodesKeepTheOutsideOutside) {
  GltfFile file = square_gltf();
  file.scene({{{"mesh", 0}, {"scale", {1, 1, -2}}}}, {0});  // the square lies in the mirror: its normal must turn
  EXPECT_NEAR(area(read(file)), -2, 1e-12);
  file.scene({{{"mesh", 0}, {"scale", {-1, 1, -2}}}}, {0});
  EXPECT_NEAR(area(read(file)), -2, 1e-12) << "turned about y";
}

TEST(ReadGltf, TheDefaultSceneIsTaken) {
  GltfFile file = square_gltf();
  file.mesh(0, -1);
  file.scene({{{"mesh", 0}}, {{"mesh", 1}}}, {0});
  file.json["scenes"].push_back({{"nodes", {1}}});
  EXPECT_EQ(read(file).triangles.size(), 2U);
  file.json["scene"] = 1;
  EXPECT_EQ(read(file).triangles.size(), 1U);
  file.json["scene"] = 2;
  EXPECT_TRUE(test::says(test::refusal(file.glb(), ".glb"), "scenes has 2 entries, but entry 2"));
}

TEST(ReadGltf, PrimitivesOfAMeshShareTheirPositions) {
  GltfFile file = square_gltf();
  Json& primitives = file.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  EXPECT_EQ(read(file).positions.size(), 4U);
  EXPECT_EQ(read(file).triangles.size(), 4U);
}

TEST(ReadGltf, StridesQuantisedAndSparseNumbers) {
  // Rows of 12 bytes: three shorts, then what is none of our business. The last row ends with its shorts.
  GltfFile file;
  std::vector<std::int16_t> rows;
  for (const auto& [x, y] : {std::pair{0, 0}, {32767, 0}, {32767, 32767}, {0, 32767}})
    for (int v : {x, y, 0, 77, 77, 77}) rows.push_back(static_cast<std::int16_t>(v));
  rows.resize(rows.size() - 3);
  const int positions = file.accessor(rows, 5122, "VEC3");
  file.json["accessors"][0]["count"] = 4;
  file.json["accessors"][0]["normalized"] = true;
  file.json["bufferViews"][0]["byteStride"] = 12;
  file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  file.mesh(positions, file.indices({0, 1, 2, 0, 2, 3}));
  expect_square(read(file));
  file.json["accessors"][0]["count"] = 5;
  EXPECT_TRUE(test::says(test::refusal(file.glb(), ".glb"), "accessors[0] has 5 elements"));

  GltfFile sparse = square_gltf();
  for (std::size_t i : {6U, 7U, 8U}) sparse.binary.replace(4 * i, 4, test::bytes(99.F));  // vertex 2
  sparse.accessor<std::uint8_t>({2}, 5121, "SCALAR");
  sparse.positions({1, 1, 0});
  sparse.json["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", 2}, {"componentType", 5121}}}, {"values", {{"bufferView", 3}}}};
  expect_square(read(sparse));
  sparse.json["accessors"][0].erase("bufferView");  // all others are zero
  EXPECT_EQ(read(sparse).positions[1], Vec3(0, 0, 0));
  EXPECT_EQ(read(sparse).positions[2], Vec3(1, 1, 0));
}

TEST(ReadGltf, JsonWithBuffersInFilesAndInText) {
  const test::ScratchFolder folder;
  GltfFile file = square_gltf();
  file.glb();  // writes the buffer's length
  std::filesystem::create_directory(folder.path() / "a b");
  folder.put("a b/square.bin", file.binary + "more");
  file.json["buffers"][0]["uri"] = "./a%20b/square.bin";
  expect_square(read_soup(folder.put("square.gltf", file.json.dump(1))));
  for (const char* uri : {"../square.bin", "/etc/passwd", "a/../../b", "file:///etc/passwd", "http://a/b", "",
                          "none.bin", "a%2F..%2F..%2Fb", "square.bin\n", "a b"}) {
    file.json["buffers"][0]["uri"] = uri;
    EXPECT_THROW(read_soup(folder.put("square.gltf", file.json.dump())), MeshError) << uri;
  }
  std::filesystem::create_symlink("/etc", folder.path() / "link");
  file.json["buffers"][0]["uri"] = "link/passwd";
  EXPECT_THROW(read_soup(folder.put("square.gltf", file.json.dump())), MeshError) << "leads out of the folder";

  // 4 positions as bytes (a triangle strip), in base64: 00 00 00 / 01 00 00 / 00 01 00 / 01 01 00
  GltfFile text;
  text.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 12}}};
  text.json["accessors"] = {{{"bufferView", 0}, {"componentType", 5121}, {"count", 4}, {"type", "VEC3"}}};
  text.json["buffers"] = {{{"byteLength", 12}, {"uri", "data:application/octet-stream;base64,AAAAAQAAAAEAAQEA"}}};
  text.mesh(0, -1, 5);
  const TriangleSoup soup = read_text(text.json.dump(), ".gltf");
  EXPECT_EQ(soup.positions[3], Vec3(1, 1, 0));
  EXPECT_EQ(soup.triangles[1], (Triangle{1, 3, 2}));
}

}  // namespace
}  // namespace toposcope
