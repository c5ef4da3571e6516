// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "io/mesh_io.h"
#include "scene/drawing.h"

namespace toposcope {

/// Triangles to paint, with a normal at each corner.
struct ShadedMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<std::array<Eigen::Vector3f, 3>> normals;  ///< per triangle and corner
  std::vector<Rgb> triangle_colors;                     ///< one per triangle, or
  std::vector<Rgb> vertex_colors;                       ///< one per vertex; a place has that of most of its triangle

  void append(const ShadedMesh& other);
};

/// What is on a picture.
struct Composition {
  ShadedMesh surface;       ///< casts and takes shadows
  bool show_edges = false;  ///< the triangles' edges, where they are large enough to see
  ShadedMesh lines;         ///< tubes and balls; what the surface hides of them shines through
  ShadedMesh sheets;        ///< likewise, translucent
  double line_radius = 0;   ///< of the tubes
};

/// Moved and scaled to a box of diagonal 1 about the origin: what is drawn in single precision keeps its digits
/// wherever and however large the object is.
Composition in_unit_box(Composition composition);

/// Normals at the corners of a mesh: the mean of the faces around a vertex, by their angles there, that meet the
/// triangle at less than 40 degrees, so that round things look round and edges sharp.
std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(const std::vector<Vec3>& positions,
                                                           const std::vector<Triangle>& triangles);

/// Tubes along the lines, balls at their corners and at the points.
ShadedMesh tubes(const Drawing& drawing, double radius, const Rgb& color);

ShadedMesh sheets(const Drawing& drawing, const Rgb& color);

}  // namespace toposcope
