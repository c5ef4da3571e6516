// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/errors.h"
#include "io/mesh_io.h"

namespace toposcope::test {

/// A folder that is empty at first and gone at last.
class ScratchFolder {
 public:
  ScratchFolder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("toposcope-test-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path put(const std::string& name, std::string_view content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline TriangleSoup read_text(std::string_view content, const std::string& extension) {
  static const ScratchFolder folder;
  return read_soup(folder.put("mesh" + extension, content));
}

/// The message that refuses the content, empty where it is read.
inline std::string refusal(std::string_view content, const std::string& extension) {
  static const ScratchFolder folder;
  try {
    read_mesh(folder.put("mesh" + extension, content));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

inline ::testing::AssertionResult says(const std::string& message, std::string_view part) {
  if (message.find(part) != message.npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << message << "' does not say '" << part << "'";
}

/// The bytes of a number in the given order.
template <class T>
std::string bytes(T value, std::endian order = std::endian::little) {
  std::string result(sizeof(T), '\0');
  std::copy_n(reinterpret_cast<const char*>(&value), sizeof(T), result.begin());
  if (order != std::endian::native) std::reverse(result.begin(), result.end());
  return result;
}

/// Two triangles over a unit square in z = 0, vertices in reading order.
inline void expect_square(const TriangleSoup& soup) {
  ASSERT_EQ(soup.positions.size(), 4U);
  EXPECT_EQ(soup.positions[1], Vec3(1, 0, 0));
  EXPECT_EQ(soup.positions[2], Vec3(1, 1, 0));
  EXPECT_EQ(soup.positions[3], Vec3(0, 1, 0));
  ASSERT_EQ(soup.triangles.size(), 2U);
  EXPECT_EQ(soup.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(soup.triangles[1], (Triangle{0, 2, 3}));
  EXPECT_EQ(soup.face_origin.size(), 2U);
}

}  // namespace toposcope::test
