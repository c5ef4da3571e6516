// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_io.h"

#include <algorithm>
#include <optional>

#include "base/errors.h"
#include "io/extension.h"
#include "io/file_bytes.h"
#include "io/readers.h"
#include "io/unicode.h"
#include "mesh/sound.h"

namespace toposcope {
namespace {

bool begins_with_off(std::string_view bytes) {
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  const std::size_t end = std::min(bytes.find_first_of(" \t\r\n#", begin), bytes.size());
  const std::string_view word = bytes.substr(begin, end - begin);
  return word.size() >= 3 && word.size() <= 8 && word.substr(word.size() - 3) == "OFF" &&
         word.substr(0, word.size() - 3).find_first_not_of("STCN4n") == word.npos;
}

/// So many, and so small, that the corners of neighbours were meant to be one.
bool in_pieces(const RepairReport& report, std::size_t faces) {
  constexpr std::size_t many = 32, small = 8;
  return report.components >= many && faces < small * report.components;
}

TriangleSoup read_by_format(const FileText& file, const std::string& extension) {
  if (file.bytes.starts_with("ply")) return read_ply(file);
  if (file.bytes.starts_with("glTF")) return read_gltf(file);
  if (begins_with_off(file.bytes)) return read_off(file);
  if (extension == ".stl") return read_stl(file);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".off") return read_off(file);
  if (extension == ".ply") return read_ply(file);
  if (extension == ".gltf" || extension == ".glb") return read_gltf(file);
  if (is_binary_stl(file.bytes) || file.bytes.starts_with("solid ")) return read_stl(file);
  throw MeshError(file.name + ": the format is told neither by the content nor by the extension '" + extension +
                  "'; use .ply, .obj, .stl, .off, .glb or .gltf");
}

}  // namespace

TriangleSoup read_soup(std::string_view bytes, const std::filesystem::path& path) {
  FileText file{path.string(), bytes};
  if (bytes.empty()) throw MeshError(file.name + ": the file is empty");
  std::string decoded;
  if (is_binary_stl(bytes)) {  // its header may be anything, a byte order mark too
  } else if (bytes.starts_with("\xEF\xBB\xBF")) {
    file.bytes.remove_prefix(3);
  } else if (has_utf16_mark(bytes)) {
    decoded = utf8_of_utf16(bytes);
    file.bytes = decoded;
  }
  return read_by_format(file, lower_extension(path));
}

TriangleSoup read_soup(const std::filesystem::path& path) {
  const FileBytes content = read_file_bytes(path);
  return read_soup(content.view(), path);
}

Mesh read_mesh(const std::filesystem::path& path, Context* context) {
  return Mesh(read_soup(path), path.string(), context);
}

RepairedMesh repaired_mesh(TriangleSoup soup, const std::string& name, Context* context) {
  const std::optional<RepairReport> sound = examine(soup, context);
  const RepairReport report = sound ? *sound : repair(soup, name);
  if (context && in_pieces(report, soup.triangles.size()))
    context->log(LogLevel::warning, name + ": falls into " + std::to_string(report.components) + " components of " +
                                        std::to_string(soup.triangles.size()) +
                                        " faces in all; features end where components do: merge close vertices in the "
                                        "program that made the mesh, or weld it there");
  return {Mesh(std::move(soup), name, context), report};
}

RepairedMesh read_repaired_mesh(const std::filesystem::path& path, Context* context) {
  return repaired_mesh(read_soup(path), path.string(), context);
}

}  // namespace toposcope
