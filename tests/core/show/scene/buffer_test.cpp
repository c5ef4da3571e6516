// SPDX-License-Identifier: BSD-3-Clause
// Arrays as JSON: bytes in base64, known answers and round trips.

#include "scene/buffer.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/random.h"

namespace toposcope {
namespace {

TEST(Buffer, Base64IsThatOfTheStandard) {  // RFC 4648, section 10
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(to_base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  EXPECT_EQ(from_base64(to_base64(all)), all);
  EXPECT_THROW(from_base64("Zg="), std::invalid_argument);
  EXPECT_THROW(from_base64("Zg!="), std::invalid_argument);
}

TEST(Buffer, IndicesTakeTwoBytesWhereTheyFit) {
  const SceneJson small = index_buffer(std::vector<Index>{1, 258, 65535});
  EXPECT_EQ(small["type"], "u16");
  EXPECT_EQ(small["count"], 3);
  EXPECT_EQ(from_base64(small["data"].get<std::string>()), std::string("\x01\x00\x02\x01\xff\xff", 6));
  EXPECT_EQ(read_indices(small), (std::vector<Index>{1, 258, 65535}));
  const SceneJson large = index_buffer(std::vector<Index>{7, 65536});
  EXPECT_EQ(large["type"], "u32");
  EXPECT_EQ(from_base64(large["data"].get<std::string>()), std::string("\x07\x00\x00\x00\x00\x00\x01\x00", 8));
  EXPECT_EQ(read_indices(large), (std::vector<Index>{7, 65536}));
}

TEST(Buffer, QuantisedPointsAreOffByHalfAStepAtMost) {
  std::vector<Vec3> points;
  test::Random random(3);
  for (int i = 0; i < 1000; ++i)
    points.emplace_back(random.uniform(-3, 5), random.uniform(1e6, 1e6 + 1), 42);  // the last of no extent
  const SceneJson buffer = quantised_buffer(points);
  const std::vector<Vec3> read = read_points(buffer);
  ASSERT_EQ(read.size(), points.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_NEAR(read[i].x(), points[i].x(), 8.0 / 65535 / 2 * 1.001);
    EXPECT_NEAR(read[i].y(), points[i].y(), 1.0 / 65535 / 2 * 1.001);
    EXPECT_EQ(read[i].z(), 42);
  }
}

TEST(Buffer, RefusesWhatDoesNotAddUp) {
  SceneJson buffer = point_buffer(std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(read_points(buffer)[1], Vec3(4, 5, 6));
  EXPECT_THROW(read_indices(buffer), std::invalid_argument);
  buffer["count"] = 5;
  EXPECT_THROW(read_points(buffer), std::invalid_argument);
  EXPECT_THROW(read_triangles(index_buffer(std::vector<Index>{0, 1, 2, 3})), std::invalid_argument);
}

}  // namespace
}  // namespace toposcope
