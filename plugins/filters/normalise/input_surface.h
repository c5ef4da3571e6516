// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "surface_mesh.h"
#include "toposcope/geometry/closest_face.h"

namespace toposcope::normalise {

/// The input: where every vertex of the working mesh lies. Points are followed from face to face, so that a vertex
/// never leaps to the other side of a thin wall.
class InputSurface {
 public:
  /// \param crease_angle  radians; edges whose faces turn by more are creases
  /// \param scale  the edge length that is aimed at: creases too short to matter at it are ignored, corners of creases
  ///        are looked for at it
  /// \throw std::invalid_argument  not an oriented manifold
  InputSurface(const MeshView& mesh, double crease_angle, double scale);

  struct Place {
    Index at;  ///< face, or half-edge of a crease
    Vec3 point;
  };
  /// The surface's point nearest to x that a descent from `face` reaches.
  Place on_surface(Index face, const Vec3& x) const;
  /// The same along the crease or boundary from the half-edge `curve`, ending at corners.
  Place on_curve(Index curve, const Vec3& x) const;

  const MeshView& mesh() const { return mesh_; }
  const std::vector<Index>& opposite() const { return opposite_; }
  bool is_curve(Index h) const { return curve_[h]; }
  Kind kind(Index v) const { return kind_[v]; }

 private:
  Index from(Index h) const { return mesh_.triangles[h / 3][h % 3]; }
  Index to(Index h) const { return from(next_half_edge(h)); }
  Vec3 unit_normal(Index f) const;
  double length(Index h) const { return (mesh_.positions[from(h)] - mesh_.positions[to(h)]).norm(); }
  Index beyond(Index h, Index v) const;
  void find_curves(double crease_angle, double scale);
  void find_corners(double scale);
  double turn(Index v, double scale) const;

  MeshView mesh_;
  std::vector<Index> opposite_;
  std::vector<char> curve_;                      ///< of half-edges: on a crease or the boundary
  std::vector<Kind> kind_;                       ///< of vertices
  std::vector<std::array<Index, 2>> curves_at_;  ///< of vertices with two of them
};

}  // namespace toposcope::normalise
