// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "core/kernel/io/mesh_files.h"

namespace toposcope {
namespace {

using test::bytes, test::expect_square, test::read_text, test::refusal, test::says;

const std::string ascii =
    "solid vertex 1 2\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 1 0\n"
    "  endloop\n endfacet\n facet normal 0 0 1\n  outer loop\n   vertex -0 0 0\n   vertex 1 1 0\n   vertex 0 1e0 0\n"
    "  endloop\n endfacet\nendsolid vertex\n";

std::string binary(const std::string& header, std::uint32_t count, float odd = 1) {
  std::string file = header;
  file.resize(80, ' ');
  file += bytes(count);
  for (const std::array<float, 9>& facet :
       {std::array<float, 9>{0, 0, 0, 1, 0, 0, 1, 1, 0}, std::array<float, 9>{0, 0, -0.F, 1, odd, 0, 0, 1, 0}}) {
    file += std::string(12, '\0');
    for (float coordinate : facet) file += bytes(coordinate);
    file += std::string(2, '\7');
  }
  return file;
}

TEST(ReadStl, AsciiWeldsEqualPositions) {
  expect_square(read_text(ascii, ".stl"));
  std::string loud = ascii;
  for (char& c : loud)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  expect_square(read_text(loud, ".STL"));
  expect_square(read_text("solid empty\nendsolid empty\n" + ascii, ".stl"));
  expect_square(read_text(ascii, ".txt"));
}

TEST(ReadStl, BinaryAlsoWhereItBeginsWithSolid) {
  expect_square(read_text(binary("made by hand", 2), ".stl"));
  expect_square(read_text(binary("solid facet normal", 2), ".stl"));
  expect_square(read_text(binary("made by hand", 2), ".bin"));
  expect_square(read_text(binary("made by hand", 2) + "more behind", ".stl"));
}

TEST(ReadStl, TheSizeTellsWhereTheCountWasNotWritten) {
  for (std::uint32_t count : {0U, 1U, 4294967295U}) expect_square(read_text(binary("COLOR=rgba", count), ".stl"));
  EXPECT_EQ(read_text(binary("x", 1) + "behind", ".stl").triangles.size(), 1U) << "not whole facets: the count tells";
}

TEST(ReadStl, SeveralSolidsAreOneMesh) {
  const TriangleSoup soup = read_text(ascii + "\n" + ascii, ".stl");
  EXPECT_EQ(soup.triangles.size(), 4U);
  EXPECT_EQ(soup.positions.size(), 4U);
  std::string old_mac = ascii;
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  expect_square(read_text(old_mac, ".stl"));
}

TEST(ReadStl, WeldsManyCorners) {
  // Every corner of a fan around one point, in an order that visits each position twice.
  std::string text = "solid\n";
  const int count = 3000;
  for (int i = 0; i < count; ++i) {
    text += "facet normal 0 0 0\nouter loop\nvertex 0 0 0\n";
    for (int j : {i, i + 1}) text += "vertex " + std::to_string(j) + " 1 " + std::to_string(j * j) + "\n";
    text += "endloop\nendfacet\n";
  }
  const TriangleSoup soup = read_text(text, ".stl");
  EXPECT_EQ(soup.positions.size(), static_cast<std::size_t>(count) + 2);
  EXPECT_EQ(soup.triangles.size(), static_cast<std::size_t>(count));
  for (Index f = 0; f < soup.triangles.size(); ++f) EXPECT_EQ(soup.triangles[f], (Triangle{0, f + 1, f + 2}));
}

TEST(ReadStl, Refusals) {
  EXPECT_TRUE(says(refusal(binary("x", 3), ".stl"), "announces 3 facets but the file holds 2"));
  EXPECT_TRUE(says(refusal(binary("x", 4294967295U) + "x", ".stl"), "announces 4294967295 facets"));
  EXPECT_TRUE(says(refusal(binary("x", 0).substr(0, 84), ".stl"), "no vertex"));
  EXPECT_TRUE(says(refusal("garbage", ".stl"), "cut short"));
  EXPECT_TRUE(says(refusal(binary("x", 2, std::numeric_limits<float>::quiet_NaN()), ".stl"), "byte 146: vertex 3"));
  EXPECT_TRUE(says(refusal("solid a\nendsolid a\n", ".stl"), "no vertex"));
  EXPECT_TRUE(says(refusal("solid a\nfacet\nouter loop\nvertex 1 2 x\n", ".stl"), "mesh.stl:4: expected a coordinate"));
  EXPECT_TRUE(says(refusal("solid a\nvertex 1 2 3\n", ".stl"), ":2: unexpected 'vertex' outside of a facet"));
  EXPECT_TRUE(says(refusal("solid a\nfacet\nfacet\n", ".stl"), ":3: unexpected 'facet' in a facet"));
  for (std::size_t size = 0; size < ascii.find("endfacet"); ++size)
    EXPECT_NE(refusal(ascii.substr(0, size), ".stl"), "") << size << " bytes";
  for (std::size_t size = 0; size < 184; ++size)
    EXPECT_NE(refusal(binary("x", 2).substr(0, size), ".stl"), "") << size << " bytes";
}

}  // namespace
}  // namespace toposcope
