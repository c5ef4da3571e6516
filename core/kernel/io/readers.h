// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "io/soup_builder.h"
#include "mesh/mesh.h"

namespace toposcope {

/// A file read whole.
struct FileText {
  std::string name;  ///< for messages; its folder holds what the file refers to
  std::string_view bytes;
};

/// PLY 1.0: ASCII and binary of both byte orders, any scalar types, other elements and properties skipped.
TriangleSoup read_ply(const FileText& file);
/// Wavefront OBJ: `v` and `f`; all else is skipped.
TriangleSoup read_obj(const FileText& file);
/// STL, ASCII or binary; corners at equal positions become one vertex.
TriangleSoup read_stl(const FileText& file);
/// Geomview OFF, ASCII or binary, also with colours (C), normals (N) and texture coordinates (ST).
TriangleSoup read_off(const FileText& file);
/// glTF 2.0, binary (GLB) or JSON: the triangles of the default scene in its coordinates.
TriangleSoup read_gltf(const FileText& file);

/// True where the size of the file is what its facet count asks for.
bool is_binary_stl(std::string_view bytes);

}  // namespace toposcope
