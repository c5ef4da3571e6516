// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "core/kernel/io/mesh_files.h"

namespace toposcope {
namespace {

using test::bytes, test::expect_square, test::read_text, test::refusal, test::says;

const std::string ascii_header =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ascii_body = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

std::string with_crlf(std::string text) {
  for (std::size_t i = text.find('\n'); i != text.npos; i = text.find('\n', i + 2)) text.insert(i, 1, '\r');
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

/// A quad with a property of every type before, between and behind what counts, and elements around.
std::string binary_with_everything(std::endian order, const std::string& ending) {
  std::string header = "ply\nformat binary_" + std::string(order == std::endian::little ? "little" : "big") +
                       "_endian 1.0\nobj_info none\nelement camera 2\nproperty double focus\n"
                       "property list ushort short marks\nelement vertex 4\nproperty uint8 flag\nproperty double z\n"
                       "property int16 x\nproperty list uint16 float64 weights\nproperty float32 y\nproperty char c\n"
                       "element nothing 3\nelement face 1\nproperty uint32 id\n"
                       "property list int uint vertex_index\nproperty list char ushort texture\nend_header\n";
  if (ending == "\r\n") header = with_crlf(header);
  if (ending == "\r") std::replace(header.begin(), header.end(), '\n', '\r');
  std::string body;
  for (int i = 0; i < 2; ++i)
    body += bytes(1.5, order) + bytes(std::uint16_t{2}, order) + bytes(std::int16_t{-1}, order) +
            bytes(std::int16_t{300}, order);
  const std::array<std::array<int, 2>, 4> corners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (const auto& [x, y] : corners)
    body += bytes(std::uint8_t{10}, order) + bytes(0.0, order) + bytes(static_cast<std::int16_t>(x), order) +
            bytes(std::uint16_t{1}, order) + bytes(0.25, order) + bytes(static_cast<float>(y), order) +
            bytes(std::int8_t{-1}, order);
  body += bytes(std::uint32_t{7}, order) + bytes(std::int32_t{4}, order);
  for (std::uint32_t v = 0; v < 4; ++v) body += bytes(v, order);
  body += bytes(std::int8_t{1}, order) + bytes(std::uint16_t{9}, order);
  return header + body;
}

TEST(ReadPly, Ascii) {
  expect_square(read_text(ascii_header + ascii_body, ".ply"));
  expect_square(read_text(with_crlf(ascii_header + ascii_body), ".ply"));
  std::string old_mac = ascii_header + ascii_body;
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  expect_square(read_text(old_mac, ".ply"));
  expect_square(read_text(ascii_header + "0 0 0 1 0 0\n+1 1.0e0 0\n 0 1 -0\n4 0 1\n 2 3", ".ply"));
  expect_square(read_text("\xEF\xBB\xBF" + ascii_header + ascii_body, ".ply"));
  expect_square(read_text(ascii_header + ascii_body, ".stl"));
  expect_square(read_text(replaced(with_crlf(ascii_header), "float x\r\n", "float x\n") + ascii_body, ".ply"));
}

TEST(ReadPly, PolygonsKeepTheirOrigin) {
  const TriangleSoup soup = read_text(replaced(ascii_header, "face 1", "face 4") +
                                          replaced(ascii_body, "4 0 1 2 3", "3 0 1 2\n4 0 1 2 3\n2 0 1\n3 2 3 0"),
                                      ".ply");
  EXPECT_EQ(soup.input_faces, 4U);
  EXPECT_EQ(soup.face_origin, (std::vector<Index>{0, 1, 1, 3}));
}

TEST(ReadPly, StripsAlternateAndEndAtMinusOne) {
  const std::string header = replaced(replaced(ascii_header, "element face 1", "element tristrips 2"), "uchar", "int");
  const TriangleSoup soup =
      read_text(header + replaced(ascii_body, "4 0 1 2 3", "9 0 1 2 3 -1 3 1 0 0\n3 2 1 0"), ".ply");
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 1, 0}, {2, 1, 0}}));
  EXPECT_EQ(soup.input_faces, 4U) << "the one that repeats a corner joins strips";
}

TEST(ReadPly, BinaryFacesOfMixedSizes) {
  std::string header = replaced(ascii_header, "ascii", "binary_little_endian");
  header = replaced(replaced(header, "face 1", "face 5"), "vertex_indices\n", "vertex_indices\nproperty uchar red\n");
  std::string body;
  for (float coordinate : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 0.F}) body += bytes(coordinate);
  const auto face = [&](std::initializer_list<std::int32_t> corners) {
    body += static_cast<char>(corners.size());
    for (std::int32_t corner : corners) body += bytes(corner);
    body += 'r';
  };
  face({0, 1, 2});
  face({0, 1, 2, 3});
  face({0, 1});
  face({2, 3, 0});
  const std::size_t last = header.size() + body.size();
  std::string good = body;
  face({1, 2, 3});
  const TriangleSoup soup = read_text(header + body, ".ply");
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {2, 3, 0}, {1, 2, 3}}));
  EXPECT_EQ(soup.face_origin, (std::vector<Index>{0, 1, 1, 3, 4}));
  for (std::int32_t wrong : {4, -1, std::numeric_limits<std::int32_t>::min()}) {
    body = good;
    face({1, 2, wrong});
    EXPECT_TRUE(says(refusal(header + body, ".ply"), "byte " + std::to_string(last + 1) + ": "));
    EXPECT_TRUE(says(refusal(header + body, ".ply"), "vertex " + std::to_string(wrong) + " (from 0)"));
  }
}

TEST(ReadPly, BinaryInBothOrdersWithAllTypesAndForeignElements) {
  for (std::endian order : {std::endian::little, std::endian::big})
    for (const char* ending : {"\n", "\r\n", "\r"})
      expect_square(read_text(binary_with_everything(order, ending), ".ply"));
}

TEST(ReadPly, BinaryDataThatBeginsWithALineFeed) {
  const std::string header =
      "ply\rformat binary_little_endian 1.0\relement face 1\rproperty list uchar uchar vertex_index\r"
      "element vertex 10\rproperty char x\rproperty char y\rproperty char z\rend_header\r";
  std::string body = "\n";  // ten corners
  for (char v = 0; v < 10; ++v) body += v;
  for (char v = 0; v < 10; ++v) body += {v, static_cast<char>(v * v), 0};
  const TriangleSoup soup = read_text(header + body, ".ply");
  EXPECT_EQ(soup.triangles.size(), 8U);
  EXPECT_EQ(soup.positions[9], Vec3(9, 81, 0));
}

TEST(ReadPly, EveryTruncationIsRefused) {
  for (const std::string& whole : {ascii_header + ascii_body, binary_with_everything(std::endian::little, "\n"),
                                   binary_with_everything(std::endian::big, "\r\n")}) {
    const std::size_t end = whole.find("4 0 1 2 3") != whole.npos ? whole.find("4 0 1 2 3") + 8 : whole.size();
    for (std::size_t size = 0; size < end; ++size)
      EXPECT_NE(refusal(whole.substr(0, size), ".ply"), "") << size << " bytes";
  }
}

TEST(ReadPly, CountsThatLieAreRefusedBeforeAnythingIsReserved) {
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "vertex 4", "vertex 4000000000000000000") + ascii_body, ".ply"),
                   "mesh.ply:4: the header announces 4000000000000000000 rows of 'vertex'"));
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "face 1", "face 999999999") + ascii_body, ".ply"), ":8: "));
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "vertex 4", "vertex 99999999999999999999") + ascii_body, ".ply"),
                   "expected a count"));
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "vertex 4", "vertex -4") + ascii_body, ".ply"), "expected a count"));
  EXPECT_TRUE(
      says(refusal(ascii_header + replaced(ascii_body, "4 0", "4000000000 0"), ".ply"), "list 'vertex_indices'"));
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "4 0", "-4 0"), ".ply"), "list 'vertex_indices'"));
  // An element without properties has rows without bytes: any number of them.
  expect_square(read_text(
      replaced(ascii_header, "element face", "element none 9999999999999999999\nelement face") + ascii_body, ".ply"));
}

TEST(ReadPly, ErrorsNameTheLine) {
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "1 1 0", "1 nan 0"), ".ply"), "mesh.ply:13: vertex 2"));
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "1 1 0", "1 inf 0"), ".ply"), "not a finite number"));
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "1 1 0", "1 1e999 0"), ".ply"), ":13: '1e999'"));
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "1 1 0", "1 1,5 0"), ".ply"), "found '1,5'"));
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "1 2 3", "1 2 4"), ".ply"),
                   "mesh.ply:15: a face refers to vertex 4"));
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "1 2 3", "1 2 -1"), ".ply"), ":15: face 0"));
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "1 2 3", "1 2 2.5"), ".ply"), "whole number"));
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "float z", "quad z") + ascii_body, ".ply"),
                   ":7: unknown property type 'quad'"));
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "float z", "float w") + ascii_body, ".ply"), "one property 'z'"));
  EXPECT_TRUE(
      says(refusal(replaced(ascii_header, "vertex_indices", "corners") + ascii_body, ".ply"), "vertex_indices"));
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "ascii", "utf8") + ascii_body, ".ply"), ":2: unknown format"));
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "format ascii 1.0\n", "") + ascii_body, ".ply"), "names no format"));
  EXPECT_TRUE(
      says(refusal(replaced(ascii_header, "comment", "koment") + ascii_body, ".ply"), ":3: unexpected 'koment'"));
}

TEST(ReadPly, BinaryErrorsNameTheByte) {
  std::string header = replaced(ascii_header, "ascii", "binary_little_endian");
  std::string body;
  for (float coordinate :
       {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, std::numeric_limits<float>::quiet_NaN(), 0.F, 0.F, 1.F, 0.F})
    body += bytes(coordinate);
  body += '\0';
  EXPECT_TRUE(says(refusal(header + body, ".ply"), "byte " + std::to_string(header.size() + 24) + ": vertex 2"));
}

TEST(ReadPly, PointsAreNoMesh) {
  EXPECT_TRUE(says(refusal(replaced(ascii_header, "face 1", "face 0") + ascii_body, ".ply"), "4 vertices but no face"));
  EXPECT_TRUE(
      says(refusal(ascii_header + replaced(ascii_body, "4 0 1 2 3", "0"), ".ply"), "no face with three corners"));
  EXPECT_TRUE(says(refusal(ascii_header + replaced(ascii_body, "4 0 1 2 3", "3 0 1 1"), ".ply"), "repeats a vertex"));
  EXPECT_TRUE(says(refusal("ply\nformat ascii 1.0\nend_header", ".ply"), "no vertex"));
}

}  // namespace
}  // namespace toposcope
