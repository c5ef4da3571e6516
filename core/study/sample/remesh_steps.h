// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Steps of remesh(): the half-edges that it works on, the edge lengths that it aims at, and their number.

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstddef>
#include <vector>

#include "sample/implicit.h"

namespace toposcope {

struct RemeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using Halfedges = OpenMesh::TriMesh_ArrayKernelT<RemeshTraits>;
using Point = Halfedges::Point;

inline Point to_point(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
inline Vec3 to_vec(const Point& p) {
  return {p[0], p[1], p[2]};
}

inline constexpr double rough = 1e-3;  ///< of an edge: how far from the surface vertices may be while they move

/// How well a face at these corners follows the surface: cosine between its normal and the corners' normals.
double agreement(const Point& a, const Point& b, const Point& c, const Point& normal);

/// Target edge lengths: short where the surface bends, so that a chord spans at most about `turn` radians of it,
/// growing slowly away from there.
struct SizeField {
  static constexpr double turn = 0.7;
  static constexpr double least = 0.4;   ///< of the greatest
  static constexpr double growth = 0.4;  ///< of the target length, per length along the surface
  double greatest = 0;
  std::vector<double> target;  ///< by vertex

  double along(const Halfedges& mesh, Halfedges::EdgeHandle e) const {
    const auto h = mesh.halfedge_handle(e, 0);
    return 0.5 * (target[index(mesh.from_vertex_handle(h))] + target[index(mesh.to_vertex_handle(h))]);
  }
  static std::size_t index(Halfedges::VertexHandle v) { return static_cast<std::size_t>(v.idx()); }
};

/// \param greatest  target length where the surface is flat
SizeField measure_sizes(const Halfedges& mesh, double greatest);

/// Cuts edges that are longer than their target at their middle.
void split_edges(Halfedges& mesh, const Implicit& surface, double greatest);

/// Collapses edges, those shortest for their target first, in rounds: what a collapse has touched waits for the next.
/// A priority queue would do it one by one, and spend most of its time on testing what it does not take.
void decimate(Halfedges& mesh, double greatest, std::size_t faces);

}  // namespace toposcope
