// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_io.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "base/errors.h"
#include "io/extension.h"
#include "io/readers.h"

namespace toposcope {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Reads a regular file whole: what a pipe or a device would give has no end.
std::unique_ptr<char[]> read_whole(const std::filesystem::path& path, std::size_t& size) {
  const std::string name = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw MeshError(name + ": no such file");
  if (!std::filesystem::is_regular_file(status))
    throw MeshError(name + ": not a file that can be read as a mesh" + (error ? " (" + error.message() + ")" : ""));
  const auto length = std::filesystem::file_size(path, error);
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(name.c_str(), "rb"));
  if (error || !file) throw MeshError(name + ": cannot be opened (" + std::strerror(errno) + ")");
  auto bytes = std::make_unique_for_overwrite<char[]>(length);
  size = std::fread(bytes.get(), 1, length, file.get());
  if (std::ferror(file.get())) throw MeshError(name + ": cannot be read (" + std::strerror(errno) + ")");
  return bytes;
}

bool begins_with_off(std::string_view bytes) {
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  const std::size_t end = std::min(bytes.find_first_of(" \t\r\n#", begin), bytes.size());
  const std::string_view word = bytes.substr(begin, end - begin);
  return word.size() >= 3 && word.size() <= 8 && word.substr(word.size() - 3) == "OFF" &&
         word.substr(0, word.size() - 3).find_first_not_of("STCN4n") == word.npos;
}

}  // namespace

TriangleSoup read_soup(const std::filesystem::path& path) {
  std::size_t size = 0;
  const std::unique_ptr<char[]> content = read_whole(path, size);
  FileText file{path.string(), {content.get(), size}};
  if (file.bytes.empty()) throw MeshError(file.name + ": the file is empty");
  if (file.bytes.substr(0, 3) == "\xEF\xBB\xBF") file.bytes.remove_prefix(3);  // byte order mark of UTF-8

  const std::string extension = lower_extension(path);
  if (file.bytes.substr(0, 3) == "ply") return read_ply(file);
  if (begins_with_off(file.bytes)) return read_off(file);
  if (extension == ".stl") return read_stl(file);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".off") return read_off(file);
  if (extension == ".ply") return read_ply(file);
  if (is_binary_stl(file.bytes) || file.bytes.substr(0, 6) == "solid ") return read_stl(file);
  throw MeshError(file.name + ": the format is told neither by the content nor by the extension '" + extension +
                  "'; use .ply, .obj, .stl or .off");
}

Mesh read_mesh(const std::filesystem::path& path, Context* context) {
  return Mesh(read_soup(path), path.string(), context);
}

}  // namespace toposcope
