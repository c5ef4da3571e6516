// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Meshes of surfaces whose principal curvatures are known at every point.

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace toposcope::test {

enum class Sampling {
  regular,    ///< a grid, all diagonals alike
  irregular,  ///< vertices moved at random by up to 0.4 cells both ways, diagonals at random
};

struct AnalyticSurface {
  TriangleSoup mesh;
  std::vector<double> maximum, minimum;  ///< principal curvatures at each vertex, convex positive
  std::vector<bool> interior;            ///< false within a few cells of a border
};

/// Kinds: sphere (radius 1, without its poles), cylinder (radius 1, height 2 pi), torus (radii 2 and 1),
/// saddle (z = (x^2 - y^2) / 2 over [-1, 1]^2).
/// \param noise  sd of a displacement along the normal, in mean edges
AnalyticSurface make_surface(const std::string& kind, Index faces, Sampling sampling, double noise, std::uint64_t seed);

/// Schwarz's lantern: a cylinder of radius 1 and height 2 in bands, each turned against the next by half a facet.
/// Its vertices lie on the cylinder; with bands of the order of around^2 its faces' normals do not.
AnalyticSurface make_lantern(int around, int bands);

}  // namespace toposcope::test
