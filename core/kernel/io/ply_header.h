// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "io/readers.h"

namespace toposcope {

enum class PlyFormat { ascii, binary_little, binary_big };
enum class PlyScalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t ply_scalar_size(PlyScalar type);

struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::float32;
  PlyScalar count_type = PlyScalar::uint8;  ///< of a list
  bool is_list = false;
  int axis = -1;            ///< 0, 1, 2 for the coordinates of a vertex
  bool is_corners = false;  ///< the vertex indices of a face
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;  ///< as announced: not to be trusted
  std::vector<PlyProperty> properties;
  std::size_t line = 0;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;   ///< bytes up to the data
  std::size_t lines = 0;  ///< lines up to the data
};

/// \throw MeshError  not a PLY header, without end, a vertex without x y z, an unknown type
PlyHeader read_ply_header(const FileText& file);

}  // namespace toposcope
