// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// Principal curvatures per vertex, 1 / mesh unit; convex is positive (the surface bends away from its normal).
struct Curvature {
  std::vector<double> maximum;
  std::vector<double> minimum;
};

/// Unit vertex normals by a least-squares plane through the vertex and its one-ring (dissertation 4.2), pointing to the
/// side of the incident faces' normals. Where the ring has no plane (fewer than two neighbours) the faces' mean normal.
std::vector<Vec3> plane_fit_normals(const MeshView& mesh, Context& context);

/// The extreme turnings of the normal from each vertex p to the vertices q within `rings` edges:
/// |n_p - n_q| / |p - q|, positive where (n_p - n_q) . (p - q) >= 0 (Itter and Jain, dissertation 4.2; the sign: the
/// dissertation's own test depends on the unit of length).
/// Overestimates on coarse meshes, since |p - q| is the chord.
Curvature turning_curvature(const MeshView& mesh, const std::vector<Vec3>& normals, int rings, Context& context);

/// The mean over vertex and one-ring, `passes` times.
void smooth_over_ring(const MeshView& mesh, std::vector<double>& field, int passes, Context& context);

/// Sum of the triangles' areas.
double surface_area(const MeshView& mesh);

/// How many rings of edges reach about as far as `radius`: at least 1, at most 8.
int rings_within(const MeshView& mesh, double radius);

}  // namespace toposcope
