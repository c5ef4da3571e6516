// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "toposcope/mesh_view.h"

namespace creases {

using toposcope::Index;
using toposcope::MeshView;
using toposcope::Vec3;

/// rad, between the normals of two faces: from there on an edge is a crease. Prisms of nine sides and more are round.
inline constexpr double sharp = 40.5 * toposcope::pi / 180;

/// An edge between two faces.
struct Edge {
  Index from, to;     ///< vertices, ascending
  Index left, right;  ///< faces
  double turn;        ///< rad, between their normals; convex positive
  double length;
};
/// Those of exactly two faces that run along it in opposite directions.
std::vector<Edge> edges_of(const MeshView& mesh);

/// The normal of a face, as long as twice its area.
inline Vec3 twice_area(const MeshView& mesh, Index face) {
  const auto& [a, b, c] = mesh.triangles[face];
  return (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
}

/// Creases one after the other, to where three meet, the line turns a corner or the crease's sign changes.
struct Line {
  std::vector<Index> vertices;  ///< along the line
  bool convex = true;
  bool closed = false;
};
std::vector<Line> crease_lines(const MeshView& mesh, const std::vector<Edge>& edges);

}  // namespace creases
