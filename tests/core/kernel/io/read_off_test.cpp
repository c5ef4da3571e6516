// SPDX-License-Identifier: BSD-3-Clause
#include "core/kernel/io/mesh_files.h"

namespace toposcope {
namespace {

using test::expect_square, test::read_text, test::refusal, test::says;

const std::string body = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

TEST(ReadOff, AllFormsOfTheHeader) {
  for (const char* header : {"OFF\n4 1 0\n", "OFF 4 1 0\n", "OFF4 1 4 # glued\n", "4 1 0\n", "OFF\n4 1\n",
                             "STCNOFF\n4 1 0\n", "# comment\n\n OFF # more\n#\n4 1 0\n\n", "OFF\r\n4 1 0\r\n"})
    expect_square(read_text(header + body, ".off"));
  expect_square(read_text("OFF\n4 1 0\n" + body.substr(0, body.size() - 1), ".txt"));
}

TEST(ReadOff, ColoursNormalsAndCommentsAreSkipped) {
  expect_square(
      read_text("CNOFF\n4 1 0\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 0.5 0.5 0.5 # red\n\n1 1 0\n# none\n0 1 0 9\n"
                "4 0 1 2 3 255 0 0\n",
                ".off"));
}

/// A number as binary OFF holds it.
template <class T>
std::string big(std::initializer_list<T> values) {
  std::string result;
  for (T value : values) result += test::bytes(value, std::endian::big);
  return result;
}

TEST(ReadOff, Binary) {
  const auto file = [](const std::string& keyword, int more) {
    std::string result = keyword + big<std::int32_t>({4, 1, 0});
    for (const auto& [x, y] : {std::pair{0.F, 0.F}, {1.F, 0.F}, {1.F, 1.F}, {0.F, 1.F}}) {
      result += big({x, y, 0.F});
      for (int i = 0; i < more; ++i) result += big({0.5F});
    }
    return result + big<std::int32_t>({4, 0, 1, 2, 3}) + big<std::int32_t>({2}) + big({1.F, 2.F});
  };
  expect_square(read_text(file("OFF BINARY\n", 0), ".off"));
  expect_square(read_text(file("# comment\nCOFF BINARY \r\n", 4), ".off"));
  expect_square(read_text(file("STCNOFF BINARY\n", 9), ".txt"));
  std::string little = "OFF BINARY\n";  // without colours: pmp-library
  for (std::int32_t count : {4, 1, 0}) little += test::bytes(count);
  for (float coordinate : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 0.F})
    little += test::bytes(coordinate);
  for (std::int32_t corner : {4, 0, 1, 2, 3}) little += test::bytes(corner);
  expect_square(read_text(little, ".off"));
  const std::string whole = file("NOFF BINARY\n", 3);
  for (std::size_t size = 0; size < whole.size() - 8; ++size)
    EXPECT_NE(refusal(whole.substr(0, size), ".off"), "") << size << " bytes";
  EXPECT_TRUE(says(refusal("OFF BINARY\n" + big<std::int32_t>({-1, 1, 0}), ".off"), "byte 11: -1 as the number"));
  EXPECT_TRUE(says(refusal("OFF BINARY\n" + big<std::int32_t>({0, 1 << 30, 0}), ".off"), "byte 15: 1073741824 as"));
}

TEST(ReadOff, Refusals) {
  EXPECT_TRUE(says(refusal("OFF\n353535235358 1 0\n" + body, ".off"), "mesh.off:2: the header announces 353535235358"));
  EXPECT_TRUE(says(refusal("OFF\n4 99999999999 0\n" + body, ".off"), "as the number of faces"));
  EXPECT_TRUE(says(refusal("OFF\n-4 1 0\n" + body, ".off"), "announces -4"));
  EXPECT_TRUE(says(refusal("OFF BINARY\n4 1 0\n", ".off"), "mesh.off: byte 11: "));
  EXPECT_TRUE(says(refusal("4OFF\n4 1 0\n" + body, ".off"), "not supported"));
  EXPECT_TRUE(says(refusal("COFFEE\n4 1 0\n" + body, ".off"), "found 'EE'"));
  EXPECT_TRUE(says(refusal("tea\n4 1 0\n" + body, ".off"), "expected OFF but found 'tea'"));
  EXPECT_TRUE(says(refusal("OFF\n5 1 0\n" + body + "3 0 1", ".off"), "cut short"));
  EXPECT_TRUE(says(refusal("OFF\n4 0 0\n" + body, ".off"), "no face"));
  EXPECT_TRUE(
      says(refusal("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 4\n", ".off"), "mesh.off:7: a face refers to"));
  EXPECT_TRUE(says(refusal("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n300 0 1 2\n", ".off"), "a face of 300 corners"));
  EXPECT_TRUE(says(refusal("OFF\n4 1 0\n0 0 0\n1 inf 0\n1 1 0\n0 1 0\n3 0 1 2\n", ".off"), ":4: vertex 1"));
  const std::string whole = "OFF\n4 1 0\n" + body;
  for (std::size_t size = 0; size + 2 < whole.size(); ++size)
    EXPECT_NE(refusal(whole.substr(0, size), ".off"), "") << size << " bytes";
}

}  // namespace
}  // namespace toposcope
