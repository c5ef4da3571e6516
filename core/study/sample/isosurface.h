// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mesh/mesh.h"
#include "sample/implicit.h"
#include "toposcope/context.h"

namespace toposcope {

/// Values on the nodes of a cubic grid, x fastest, negative inside.
struct NodeGrid {
  Vec3 origin = Vec3::Zero();
  double spacing = 0;
  std::array<std::size_t, 3> size = {0, 0, 0};
  std::vector<float> values;

  std::size_t node(std::size_t x, std::size_t y, std::size_t z) const { return x + size[0] * (y + size[1] * z); }
  Vec3 position(std::size_t x, std::size_t y, std::size_t z, const Vec3& within = Vec3::Zero()) const {
    const Vec3 corner(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    return origin + spacing * (corner + within);
  }
};

/// A grid from `low` to `high` and some nodes more; each size is a multiple of 16.
/// \throw std::length_error  more nodes than fit into 2^31
NodeGrid make_node_grid(const Vec3& low, const Vec3& high, double spacing);

/// Moves the vertices and returns for each its outward direction, or nothing.
using PlaceVertices = std::function<std::vector<Vec3>(std::vector<Vec3>& positions)>;

/// Surface nets (Gibson 1998): one vertex for each cell that the surface crosses, at the mean of the points where it
/// crosses the cell's edges, then moved by `place`; one quadrilateral for each grid edge it crosses, cut along the
/// diagonal whose triangles agree better with the vertices' directions, without them along the shorter one. The outer
/// nodes must lie outside.
TriangleSoup surface_net(const NodeGrid& grid, const PlaceVertices& place);

/// Surface nets (Gibson 1998) on a cubic grid of the given spacing: one vertex for each cell that the surface
/// crosses, moved onto the surface along the gradient; one quadrilateral for each grid edge it crosses, cut along its
/// shorter diagonal. `low` and `high` contain the solid. Cubes of the grid that are far from the surface are skipped
/// whole, which needs a function that changes by at most 1.25 per unit of length.
/// \param level  the net is laid at this distance outside the surface and then drawn onto it, so that edges thinner
///        than a cell come out whole
/// \throw std::length_error  more cells than fit into 2^31
TriangleSoup extract_isosurface(const Implicit& surface, const Vec3& low, const Vec3& high, double spacing,
                                double level, Context& context);

/// True where every directed edge occurs once, its opposite too, and the faces around each vertex form one fan.
bool is_closed_manifold(const TriangleSoup& mesh);

}  // namespace toposcope
