// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// Principal curvatures per vertex, 1 / mesh unit; convex is positive (the surface bends away from its normal).
struct Curvature {
  std::vector<double> maximum;  ///< the larger, by vertex
  std::vector<double> minimum;  ///< the smaller, by vertex
};

/// \name The estimate for any mesh
/// Quadrics give a shape operator at every vertex, free of bias but noisy; diffusing the operators over the surface
/// takes the noise away without flattening what bends evenly, since each is first carried into its neighbour's tangent
/// plane.
/// \{

/// The second fundamental form at a vertex in the tangent frame of its normal (tangent_frame):
/// [mean + deviator_x, deviator_y; deviator_y, mean - deviator_x], 1 / mesh unit.
struct ShapeOperator {
  double mean = 0;        ///< mean curvature
  double deviator_x = 0;  ///< with deviator_y a vector of length (maximum - minimum) / 2
  double deviator_y = 0;  ///< see deviator_x
};

/// The shape operators of a mesh.
struct ShapeOperators {
  std::vector<Vec3> normals;      ///< unit; zero at a vertex without faces
  std::vector<ShapeOperator> at;  ///< by vertex
};

/// Unit vectors that make a right-handed frame with a unit normal; a function of the normal alone [Duff2017].
struct TangentFrame {
  Vec3 u;  ///< square to the normal
  Vec3 v;  ///< the normal times u
};
TangentFrame tangent_frame(const Vec3& normal);

/// Unit vertex normals, exact on spheres [Max1999]; zero at a vertex without faces.
std::vector<Vec3> vertex_normals(const MeshView& mesh, Context& context);

/// Least-squares quadric (with constant and linear terms) around each vertex over the vertices that a walk along edges
/// reaches within twice the mean edge, its one-ring always among them. The quadratic terms are held by a slight ridge,
/// so that a direction in which the neighbourhood has no extent reads flat. Vertices that face the other way (the far
/// side of a thin wall) do not count.
ShapeOperators fit_shape_operators(const MeshView& mesh, Context& context);

/// `passes` times the mean over vertex and one-ring, each operator rotated with its tangent plane (about the line in
/// which the planes meet) into that of the vertex. Each pass adds about 0.43 squared edges of variance to the kernel.
void diffuse(const MeshView& mesh, ShapeOperators& operators, int passes, Context& context);

/// Passes that diffuse to a Gaussian of the given standard deviation (mesh unit), at least `least` and at most 8
/// (about 1.9 edges: on finer meshes the kernel shrinks with the edges, and so does the noise).
int diffusion_passes(const MeshView& mesh, double deviation, int least);

/// Eigenvalues of an operator.
struct PrincipalCurvatures {
  double maximum;  ///< 1 / mesh unit
  double minimum;  ///< 1 / mesh unit
};
inline PrincipalCurvatures principal_curvatures(const ShapeOperator& at) {
  const double half = std::sqrt(at.deviator_x * at.deviator_x + at.deviator_y * at.deviator_y);
  return {at.mean + half, at.mean - half};
}
Curvature principal_curvatures(const ShapeOperators& operators);

/// The first moment of the surface around each vertex: the mean, in radii, of the offsets of the vertices that a walk
/// along edges reaches within `reach` mean edges, weighted by area and by 1 - (distance / radius)^2, so that nothing
/// hangs on which vertices lie just within. Against the normal where the surface is convex: radius / (6 R) on a sphere
/// of radius R; 16 / (15 pi) = 0.34 at the edge of a thin sheet, which has no curvature to speak of and no one normal;
/// 0.24 at a right-angled edge [Clarenz2004].
std::vector<Vec3> first_moments(const MeshView& mesh, double reach, Context& context);

/// \}
/// \name The dissertation's estimate
/// \{

/// Unit vertex normals by a least-squares plane through the vertex and its one-ring (dissertation 4.2), pointing to the
/// side of the incident faces' normals. Where the ring has no plane (fewer than two neighbours) the faces' mean normal.
std::vector<Vec3> plane_fit_normals(const MeshView& mesh, Context& context);

/// The extreme turnings of the normal from each vertex p to the vertices q within `rings` edges:
/// |n_p - n_q| / |p - q|, positive where (n_p - n_q) . (p - q) >= 0 ([Itter1985], dissertation 4.2; the sign: the
/// dissertation's own test depends on the unit of length).
/// Overestimates on coarse, irregular or noisy meshes: an extreme over many pairs takes the worst of their errors.
Curvature turning_curvature(const MeshView& mesh, const std::vector<Vec3>& normals, int rings, Context& context);

/// The mean over vertex and one-ring, `passes` times.
void smooth_over_ring(const MeshView& mesh, std::vector<double>& field, int passes, Context& context);

/// How many rings of edges reach about as far as `radius`: at least 1, at most 8.
int rings_within(const MeshView& mesh, double radius);

/// \}

/// Mean curvature integrated over the surface that each vertex stands for, length; convex is positive. A quarter of
/// length times dihedral angle of each edge at the vertex: half of what the edge has, which its ends share
/// [CohenSteiner2003]. Edges without two faces
/// that run along them in opposite directions have none.
std::vector<double> mean_curvature_measure(const MeshView& mesh);

/// Sum of the triangles' areas.
double surface_area(const MeshView& mesh);

}  // namespace toposcope
