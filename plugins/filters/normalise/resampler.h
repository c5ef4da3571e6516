// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "input_surface.h"
#include "shape_change.h"
#include "surface_mesh.h"
#include "toposcope/context.h"

namespace toposcope::normalise {

/// Lengths in mesh units.
struct Goal {
  Index faces;
  double edge;          ///< of equilateral triangles, so many of which have the surface's area
  double max_change;    ///< of any sample of the input from the mesh
  double shape_weight;  ///< of shape change against length in the order of collapses
};

/// The operations that lead from the input to a mesh of even edges. Each is refused where it would change the topology,
/// turn a face over, move a crease, or change the shape by more than it may. All run in a fixed order; what is computed
/// in parallel is written by index.
class Resampler {
 public:
  /// \pre the surface outlives it
  Resampler(const InputSurface& surface, const Goal& goal);

  /// Splits the edges longer than `longest`, longest first, while there are fewer than `most_faces`.
  void split_long(double longest, Index most_faces);
  /// From here on every operation measures its shape change.
  void carry_samples();
  /// Collapses edges, those first that cost the least length and shape, while there are more than `least_faces`. No
  /// edge gets longer than `longest`.
  void collapse(Index least_faces, double longest, Context& context);
  /// Flips edges towards Delaunay, and where that brings the mesh nearer to the input.
  void flip();
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
  bool prepare_collapse(Index h, double longest);
  std::optional<double> collapse_cost(Index h, double longest);
  Facet facet(Index f) const;
  void take_faces_around(Index v);
  void flip_edge(Index h);
  Move wanted(Index v) const;
  Move placed(Index v, const Vec3& target) const;
  bool move(Index v, const Move& to);

  const InputSurface& surface_;
  Goal goal_;
  SurfaceMesh mesh_;
  ShapeChange change_;
  bool carrying_ = false;
  std::vector<Index> old_faces_;  // of the operation at hand
  std::vector<Facet> facets_;
};

/// 1 for equilateral triangles, 0 for degenerate ones.
double roundness(const std::array<Vec3, 3>& corner);

}  // namespace toposcope::normalise
