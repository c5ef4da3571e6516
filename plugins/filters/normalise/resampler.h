// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "input_surface.h"
#include "shape_change.h"
#include "surface_mesh.h"
#include "toposcope/context.h"

namespace toposcope::normalise {

/// Steps after which a loop asks whether it is cancelled.
constexpr Index asked_each = 1024;

/// Lengths in mesh units.
struct Goal {
  Index faces;
  double edge;          ///< of equilateral triangles, so many of which have the surface's area
  double max_change;    ///< of the shape, at any time
  double shape_weight;  ///< of shape change against length in the order of collapses
};

/// What a collapse may do.
struct Limits {
  double longest;    ///< edge that it may make
  double change;     ///< of the shape: distance of a sample of the input from the mesh
  double roundness;  ///< of the faces that it may make, unless they were worse before
};

/// The operations that lead from the input to a mesh of even edges. Each is refused where it would change the topology,
/// turn a face over, move a crease, or change the shape by more than it may. All run in a fixed order; what is computed
/// in parallel is written by index. Cancelled, each leaves off, and the mesh is whole but may be no further used.
class Resampler {
 public:
  /// \param free_change  what flips and moves may change the shape by, where it has not changed more before
  /// \pre the surface outlives it
  Resampler(const InputSurface& surface, const Goal& goal, double free_change);
  void set_free_change(double free_change) { free_change_ = free_change; }

  /// Splits the edges longer than `longest`, longest first, while there are fewer than `most_faces`.
  void split_long(double longest, Index most_faces, const Context& context);
  /// From here on every operation measures its shape change.
  void carry_samples(const Context& context);
  /// Collapses edges, those first that cost the least length and shape, while there are more than `least_faces`
  /// or edges too short for the wanted length.
  void collapse(Index least_faces, const Limits& limits, Context& context);
  /// Flips edges towards Delaunay, and where that brings the mesh nearer to the input.
  void flip(const Context& context);
  /// Moves the vertices towards the centres of their rings, along the surface.
  void relax(Context& context);

  const SurfaceMesh& mesh() const { return mesh_; }
  double mean_edge() const;

 private:
  struct Move {
    Vec3 point;
    Index anchor;
    Index curve = no_index;  // where the vertex lies on one
  };
  bool prepare_collapse(Index h, const Limits& limits);
  std::optional<double> collapse_cost(Index h, const Limits& limits);
  double off_surface() const;
  InputSurface::Place nearest(Index v, const Vec3& x) const;
  Index curve_at(Index v) const;
  Facet facet(Index f) const;
  void take_faces_around(Index v);
  void flip_edge(Index h);
  Move wanted(Index v) const;
  Move placed(Index v, const Vec3& target) const;
  bool move(Index v, const Move& to);

  const InputSurface& surface_;
  Goal goal_;
  double free_change_;
  SurfaceMesh mesh_;
  ShapeChange change_;
  bool carrying_ = false;
  std::vector<Index> old_faces_;  // of the operation at hand
  std::vector<Facet> facets_;
};

}  // namespace toposcope::normalise
