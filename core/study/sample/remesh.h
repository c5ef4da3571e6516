// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/mesh.h"
#include "sample/implicit.h"
#include "toposcope/context.h"

namespace toposcope {

/// Thins a mesh of an implicit surface to about `faces` well-shaped triangles that are near equal in size, smaller
/// where the surface bends: collapses short edges, flips edges towards Delaunay and relaxes vertices in their tangent
/// planes. Vertices stay on the surface; the topology stays. \pre mesh is a closed manifold whose vertices lie on the
/// surface \return with as many faces as asked for (to one pair), or more where the surface does not bear so few
TriangleSoup remesh(const TriangleSoup& mesh, const Implicit& surface, Index faces, Context& context);

}  // namespace toposcope
