// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "mesh/mesh.h"
#include "mesh/repair.h"

namespace toposcope {

/// Reads PLY (ASCII, binary of both byte orders), OBJ, STL (ASCII, binary; corners at equal positions are welded),
/// OFF (ASCII, binary), glTF 2.0 (.glb, .gltf). The format is told by the content, then by the extension. Polygons are
/// cut into triangles. Sizes in headers are never trusted before the bytes are there; the locale plays no role. \throw
/// MeshError  "file:line: what is wrong, and the remedy" (binary: byte offset)
TriangleSoup read_soup(const std::filesystem::path& path);

/// The same from memory. \param path  for messages, for its extension, and for the folder of a glTF's buffers
TriangleSoup read_soup(std::string_view bytes, const std::filesystem::path& path);

/// Reads and checks.
Mesh read_mesh(const std::filesystem::path& path, Context* context = nullptr);

/// A mesh that was made fit for the path, and what had to be done.
struct RepairedMesh {
  Mesh mesh;  ///< its face origins are faces of the file
  RepairReport repair;
};

/// Reads, repairs and checks.
RepairedMesh read_repaired_mesh(const std::filesystem::path& path, Context* context = nullptr);

/// \param name  for messages
RepairedMesh repaired_mesh(TriangleSoup soup, const std::string& name, Context* context = nullptr);

using Rgb = std::array<std::uint8_t, 3>;

struct FaceAttributes {
  std::span<const Rgb> colors = {};           ///< one per triangle, or empty
  std::span<const std::int32_t> labels = {};  ///< one per triangle, or empty
  std::span<const Index> input_faces = {};    ///< one per triangle, or empty: the face of the input that it came from
};

/// Whether the extension is one that write_mesh knows.
bool can_write_mesh(const std::filesystem::path& path);

/// Writes by extension: .ply (binary little-endian, with face attributes), .obj, .stl (binary), .off. The file appears
/// whole or not at all.
/// \return what the format could not hold, as a warning with its remedy; empty where it holds all (PLY, OBJ, OFF)
/// \throw MeshError unknown extension; UsageError when the file cannot be written
std::string write_mesh(const std::filesystem::path& path, std::span<const Vec3> positions,
                       std::span<const Triangle> triangles, const FaceAttributes& attributes = {});

/// Writes text so that the file appears whole or not at all. \throw UsageError
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace toposcope
