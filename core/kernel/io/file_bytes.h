// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace toposcope {

/// A file read whole.
struct FileBytes {
  std::unique_ptr<char[]> data;
  std::size_t size = 0;
  std::string_view view() const { return {data.get(), size}; }
};

/// Reads a regular file whole: what a pipe or a device would give has no end. (A mapping would be a little faster, but
/// kill the program where somebody cuts the file short meanwhile.)
/// \throw MeshError
FileBytes read_file_bytes(const std::filesystem::path& path);

}  // namespace toposcope
