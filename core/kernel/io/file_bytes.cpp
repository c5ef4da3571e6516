// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

#include "base/errors.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

FileBytes read_file_bytes(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw MeshError(name + ": no such file");
  if (!std::filesystem::is_regular_file(status))
    throw MeshError(name + ": not a file that can be read as a mesh" + (error ? " (" + error.message() + ")" : ""));
  const auto length = std::filesystem::file_size(path, error);
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(name.c_str(), "rb"));
  if (error || !file) throw MeshError(name + ": cannot be opened (" + std::strerror(errno) + ")");
  FileBytes bytes{std::make_unique_for_overwrite<char[]>(length), 0};
  advise_huge_pages(bytes.data.get(), length);
  bytes.size = std::fread(bytes.data.get(), 1, length, file.get());
  if (std::ferror(file.get())) throw MeshError(name + ": cannot be read (" + std::strerror(errno) + ")");
  return bytes;
}

}  // namespace toposcope
