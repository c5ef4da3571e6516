// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "sample/implicit.h"
#include "toposcope/context.h"

namespace toposcope {

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
