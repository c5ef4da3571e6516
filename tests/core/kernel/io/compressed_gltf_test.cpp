// SPDX-License-Identifier: BSD-3-Clause
// glTF that meshopt or Draco compressed: what the encoders write is read back; damaged bytes are refused, whatever they
// announce.

#include <meshoptimizer.h>

#include <Eigen/Geometry>

#include "core/kernel/io/gltf_files.h"
#include "support/meshes.h"
#include "support/random.h"

#if defined(TOPOSCOPE_DRACO)
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif

namespace toposcope {
namespace {

using test::GltfFile, test::Json, test::read_text, test::refusal, test::says;

std::string text_of(const std::vector<unsigned char>& bytes) {
  return std::string(bytes.begin(), bytes.end());
}

/// Adds a buffer view whose bytes are compressed with meshopt. \return its number
std::size_t compressed_view(GltfFile& file, const std::string& bytes, std::size_t count, std::size_t stride,
                            const char* mode, const char* filter) {
  const Json extension = {{"buffer", 0},
                          {"byteOffset", file.binary.size()},
                          {"byteLength", bytes.size()},
                          {"count", count},
                          {"byteStride", stride},
                          {"mode", mode},
                          {"filter", filter}};
  file.binary += bytes;
  file.binary.resize((file.binary.size() + 3) / 4 * 4, '\0');
  file.json["bufferViews"].push_back(
      {{"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{"EXT_meshopt_compression", extension}}}});
  if (stride > 4) file.json["bufferViews"].back()["byteStride"] = stride;
  return file.json["bufferViews"].size() - 1;
}

GltfFile with_meshopt(const TriangleSoup& mesh, const char* mode, const char* filter) {
  std::vector<float> positions;
  for (const Vec3& p : mesh.positions)
    for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(p[k]));
  std::vector<unsigned> indices;
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  const std::size_t vertices = mesh.positions.size();
  GltfFile file;
  std::vector<float> stored = positions;
  if (filter == std::string("EXPONENTIAL")) meshopt_encodeFilterExp(stored.data(), vertices, 12, 24, positions.data());
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(vertices, 12));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), stored.data(), vertices, 12));
  const std::size_t of_positions = compressed_view(file, text_of(bytes), vertices, 12, "ATTRIBUTES", filter);
  const bool triangles = mode == std::string("TRIANGLES");
  bytes.resize(triangles ? meshopt_encodeIndexBufferBound(indices.size(), vertices)
                         : meshopt_encodeIndexSequenceBound(indices.size(), vertices));
  bytes.resize(triangles ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size())
                         : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
  const std::size_t of_indices = compressed_view(file, text_of(bytes), indices.size(), 4, mode, "NONE");
  file.json["accessors"] = {
      {{"bufferView", of_positions}, {"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}},
      {{"bufferView", of_indices}, {"componentType", 5125}, {"count", indices.size()}, {"type", "SCALAR"}}};
  file.mesh(0, 1);
  file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  file.glb();
  file.json["buffers"].push_back({{"byteLength", 1000000}});  // where it is uncompressed, which nobody has
  return file;
}

/// The same triangles, whose corners may begin elsewhere.
void expect_same_surface(const TriangleSoup& read, const TriangleSoup& mesh, double within) {
  ASSERT_EQ(read.triangles.size(), mesh.triangles.size());
  double volume = 0, expected = 0;
  const auto add = [](const TriangleSoup& soup, double& sum) {
    for (const auto& [a, b, c] : soup.triangles)
      sum += soup.positions[a].dot(soup.positions[b].cross(soup.positions[c])) / 6;
  };
  add(read, volume);
  add(mesh, expected);
  EXPECT_NEAR(volume, expected, within * expected);
}

TEST(CompressedGltf, OfMeshoptIsRead) {
  const TriangleSoup mesh = test::make_torus(2, 0.5, 30, 14);
  for (const char* mode : {"TRIANGLES", "INDICES"})
    for (const char* filter : {"NONE", "EXPONENTIAL"}) {
      const GltfFile file = with_meshopt(mesh, mode, filter);
      const TriangleSoup read = read_text(test::glb(file.json.dump(), file.binary), ".glb");
      ASSERT_EQ(read.positions.size(), mesh.positions.size()) << mode << filter;
      for (std::size_t v = 0; v < read.positions.size(); ++v)
        EXPECT_LT((read.positions[v] - mesh.positions[v]).norm(), 1e-6);
      expect_same_surface(read, mesh, 1e-6);
    }
}

TEST(CompressedGltf, OfMeshoptIsRefusedWhereItIsDamaged) {
  const GltfFile good = with_meshopt(test::make_sphere(2), "TRIANGLES", "NONE");
  const auto refused = [&](const char* member, const Json& value) {
    Json json = good.json;
    json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][member] = value;
    return refusal(test::glb(json.dump(), good.binary), ".glb");
  };
  EXPECT_TRUE(says(refused("count", 281474976710655), "more than"));
  EXPECT_TRUE(says(refused("count", 700), "cannot be decompressed"));
  EXPECT_TRUE(says(refused("byteStride", 10), "a multiple of 4"));
  EXPECT_TRUE(says(refused("mode", "ODD"), "none of ATTRIBUTES"));
  EXPECT_TRUE(says(refused("filter", "QUATERNION"), "byteStride of 12"));
  EXPECT_TRUE(says(refused("byteOffset", 1 << 20), "of a buffer of"));
}

/// Whatever the bytes are, they are read or refused.
void read_damaged(const GltfFile& good, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    test::Random random(static_cast<std::uint64_t>(round));
    std::string binary = good.binary;
    for (Index count = 1 + random.below(8); count > 0; --count)
      binary[random.below(random.chance(0.5) ? binary.size() : 40)] = static_cast<char>(random.below(256));
    refusal(test::glb(good.json.dump(), binary), ".glb");
  }
}

TEST(CompressedGltf, OfMeshoptSurvivesDamage) {
  read_damaged(with_meshopt(test::make_sphere(1), "TRIANGLES", "EXPONENTIAL"), 500);
}

#if defined(TOPOSCOPE_DRACO)

GltfFile with_draco(const TriangleSoup& mesh, int speed) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(mesh.triangles.size()));
  const int attribute = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    std::array<Eigen::Vector3f, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = mesh.positions[mesh.triangles[f][k]].cast<float>();
    builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(static_cast<std::uint32_t>(f)), corner[0].data(),
                                      corner[1].data(), corner[2].data());
  }
  const std::unique_ptr<draco::Mesh> built = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetSpeedOptions(speed, speed);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
  draco::EncoderBuffer bytes;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*built, &bytes).ok());
  GltfFile file;
  file.binary.assign(bytes.data(), bytes.size());
  file.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", bytes.size()}}};
  file.json["accessors"] = {{{"componentType", 5126}, {"count", built->num_points()}, {"type", "VEC3"}},
                            {{"componentType", 5125}, {"count", 3 * built->num_faces()}, {"type", "SCALAR"}}};
  file.mesh(0, 1);
  file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", built->attribute(attribute)->unique_id()}}}};
  file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  file.glb();
  return file;
}

TEST(CompressedGltf, OfDracoIsRead) {
  const TriangleSoup mesh = test::make_torus(2, 0.5, 30, 14);
  for (const int speed : {0, 5, 10}) {  // edgebreaker, and 10: sequential
    const GltfFile file = with_draco(mesh, speed);
    const TriangleSoup read = read_text(test::glb(file.json.dump(), file.binary), ".glb");
    EXPECT_EQ(read.positions.size(), mesh.positions.size()) << speed;
    expect_same_surface(read, mesh, 1e-3);
  }
}

TEST(CompressedGltf, OfDracoIsRefusedWhereItIsDamaged) {
  const GltfFile good = with_draco(test::make_sphere(1), 5);
  Json json = good.json;
  json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 7;
  EXPECT_TRUE(says(refusal(test::glb(json.dump(), good.binary), ".glb"), "is 7, which is no attribute"));
  EXPECT_TRUE(
      says(refusal(test::glb(good.json.dump(), std::string(good.binary.size(), 'x')), ".glb"), "no mesh of Draco"));
  // A few bytes that announce billions of faces: the count stands behind the header of eleven bytes and the method.
  std::string huge = good.binary;
  huge.replace(12, 10, "\xff\xff\xff\xff\x0f\xff\xff\xff\xff\x0f");
  EXPECT_TRUE(says(refusal(test::glb(good.json.dump(), huge), ".glb"), "announces 4294967295 faces or vertices"));
}

TEST(CompressedGltf, OfDracoSurvivesDamage) {
  for (const int speed : {0, 10}) read_damaged(with_draco(test::make_sphere(1), speed), 300);
}

#endif

}  // namespace
}  // namespace toposcope
