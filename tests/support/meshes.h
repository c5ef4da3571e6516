// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shapes with known answers. All are centred on the origin, triangles counter-clockwise seen from outside, corners
// shared (no doubled vertices).

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace toposcope::test {

/// Unit icosahedron whose faces are cut in four `subdivisions` times, every vertex on the sphere of `radius`:
/// 20 * 4^subdivisions faces.
TriangleSoup make_sphere(int subdivisions, double radius = 1);

/// Cylinder about the z axis from -height/2 to height/2; `around` x `along` quads, each two triangles; `capped` adds
/// two fans about a vertex on the axis.
TriangleSoup make_cylinder(double radius, double height, int around, int along, bool capped = true);

/// A closed can about the z axis from -height/2 to height/2, its ends of rings like its wall: `around` vertices a ring,
/// `along` rings up the wall, `across` rings from the axis to the edge.
TriangleSoup make_can(double radius, double height, int around, int along, int across);

/// Torus about the z axis, `major` the radius of the centre circle, `minor` that of the tube; nu quads around the
/// axis, nv around the tube.
TriangleSoup make_torus(double major, double minor, int nu, int nv);

/// Flat rectangle in z = 0, normal +z, of nx x ny quads.
TriangleSoup make_grid(int nx, int ny, double width = 1, double depth = 1);

/// A closed square sheet around the origin: n x n cells above and below, one strip of cells around.
TriangleSoup make_sheet(double width, double thickness, int n);

/// Cuboid with the given sides along x, y, z; each face n x n quads.
TriangleSoup make_box(const Vec3& sides, int n = 1);

/// Every position p becomes rotation * (scale * p) + translation.
TriangleSoup transformed(TriangleSoup soup, const Eigen::Matrix3d& rotation, double scale, const Vec3& translation);

/// The same mesh with vertices and faces in another order (a function of `seed`), and the corners of each face rotated
/// at random. `face_origin` goes along with the faces.
/// \param new_vertex  if given, receives the new index of each old vertex
TriangleSoup shuffled(const TriangleSoup& soup, std::uint64_t seed, std::vector<Index>* new_vertex = nullptr);

/// A rotation uniform over all rotations; a function of `seed`.
Eigen::Matrix3d random_rotation(std::uint64_t seed);

}  // namespace toposcope::test
