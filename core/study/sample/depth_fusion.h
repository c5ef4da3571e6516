// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "sample/depth_view.h"
#include "sample/isosurface.h"

namespace toposcope {

/// How depth images are made into signed distances. Lengths.
struct DepthFusion {
  double spacing = 0;  ///< of the grid
  double level = 0;    ///< the net is laid so far outside the surface, so that parts thinner than a cell come out whole
  double noise = 0;    ///< standard deviation of the depths
};

/// The surface of the solid that the views show. Signed distances on a grid from `low` to `high`: truncated distances
/// of the views are averaged with the cosine of the view as weight (Curless and Levoy 1996); what any view saw through
/// is carved away, what none saw is inside (Pulli 1997, dissertation 2.4.2), so that the surface is closed. Of several
/// surfaces near a point the one most in front counts, within the noise: at an edge, views of one side alone would
/// round it. Nodes outside are filled in where the surface would touch itself along an edge or in a point (Latecki
/// 1997), so that it is a manifold. Its vertices are those of a surface net, moved by the distance measured there.
TriangleSoup fuse_depths(std::span<const DepthView> views, const DepthFusion& fusion, const Vec3& low, const Vec3& high,
                         Context& context);

/// For each point whether one of the views measured a surface within `tolerance` of it.
std::vector<char> measured_near(std::span<const DepthView> views, std::span<const Vec3> points, double tolerance,
                                Context& context);

}  // namespace toposcope
