// SPDX-License-Identifier: BSD-3-Clause
#include "core/kernel/io/gltf_files.h"

namespace toposcope {
namespace {

using test::expect_square, test::read_text, test::refusal, test::says, test::square_gltf;

/// Latin-1 text in UTF-16 with a mark.
std::string utf16(const std::string& text, std::endian order) {
  std::string result = test::bytes(std::uint16_t{0xFEFF}, order);
  for (const unsigned char c : text) result += test::bytes(std::uint16_t{c}, order);
  return result;
}

const std::string ply =
    "ply\nformat ascii 1.0\ncomment \xE9t\xE9\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
const std::string off = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
const std::string stl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";

TEST(OddEncodings, Utf16WithAMarkInEveryTextFormat) {
  const std::pair<std::string, const char*> files[] = {{ply, ".ply"}, {obj, ".obj"}, {off, ".off"}, {stl, ".stl"}};
  for (const auto& [text, extension] : files)
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      SCOPED_TRACE(extension);
      expect_square(read_text(utf16(text, order), extension));
    }
  const std::string in_text =
      R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5120,"count":4,"type":"VEC3"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":12}],)"
      R"("buffers":[{"byteLength":12,"uri":"data:application/octet-stream;base64,AAAAAQAAAQEAAAEA"}]})";
  expect_square(read_text(utf16(in_text, std::endian::little), ".gltf"));
}

TEST(OddEncodings, Utf8MarkInEveryTextFormat) {
  const std::pair<std::string, const char*> files[] = {{ply, ".ply"}, {obj, ".obj"}, {off, ".off"}, {stl, ".stl"}};
  for (const auto& [text, extension] : files) expect_square(read_text("\xEF\xBB\xBF" + text, extension));
}

TEST(OddEncodings, HalvesOfUtf16AreNoFault) {
  std::string odd = utf16("# \n" + obj, std::endian::little);
  odd.replace(4, 2, "\x00\xD8", 2);  // a high surrogate alone, in the comment
  expect_square(read_text(odd, ".obj"));
  EXPECT_TRUE(says(refusal("\xFF\xFEv", ".obj"), "no vertex"));
  EXPECT_TRUE(says(refusal("\xFE\xFF", ".obj"), "no vertex"));
}

TEST(OddEncodings, ABinaryStlMayBeginLikeAMark) {
  for (const char* mark : {"\xEF\xBB\xBF", "\xFF\xFE"}) {
    std::string file = mark;
    file.resize(80, ' ');
    file += test::bytes(std::uint32_t{1});
    for (const float number : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F}) file += test::bytes(number);
    file += std::string(2, '\0');
    EXPECT_EQ(read_text(file, ".stl").triangles.size(), 1U);
  }
}

TEST(OddEncodings, ObjOfTwoCoordinatesLiesInZZero) {
  expect_square(read_text("v 0 0\nv 1 0\nv 1 1 # corner\nv 0 1\nf 1 2 3 4\n", ".obj"));
  EXPECT_TRUE(
      says(refusal("v 0 0\nv 1 0 0\nv 1 1\nf 1 2 3\n", ".obj"), ":1: a vertex needs three coordinates, or two"));
  EXPECT_TRUE(says(refusal("v 0 0 0\nv 1 0\nv 1 1 0\nf 1 2 3\n", ".obj"), ":2: a vertex needs three coordinates"));
}

/// A GLB whose JSON has a length that is no multiple of four, and what lies between it and the next chunk.
std::string odd_glb(char padding, bool counted, bool right_behind) {
  test::GltfFile gltf = square_gltf();
  gltf.json["buffers"] = test::Json::array({{{"byteLength", gltf.binary.size()}}});
  std::string json = gltf.json.dump();
  while (json.size() % 4 != 1) json += ' ';
  const std::size_t length = json.size() + (counted ? 3 : 0);
  if (!right_behind) json.resize(json.size() + 3, padding);
  const auto size = [](std::size_t value) { return test::bytes(static_cast<std::uint32_t>(value)); };
  return "glTF" + size(2) + size(28 + json.size() + gltf.binary.size()) + size(length) + "JSON" + json +
         size(gltf.binary.size()) + std::string("BIN\0", 4) + gltf.binary;
}

TEST(OddEncodings, GlbChunksOfAnyLength) {
  expect_square(read_text(odd_glb(' ', false, true), ".glb"));
  expect_square(read_text(odd_glb(' ', false, false), ".glb"));
  expect_square(read_text(odd_glb('\0', true, false), ".glb"));
}

TEST(OddEncodings, GltfWithoutTrianglesSaysSo) {
  for (const int mode : {0, 1, 2, 3}) {
    test::GltfFile file;
    file.mesh(file.positions(test::square_positions()), -1, mode);
    EXPECT_TRUE(says(refusal(file.glb(), ".glb"), "points or lines only (1 primitives)"));
  }
}

}  // namespace
}  // namespace toposcope
