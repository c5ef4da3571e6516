// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mesh/clusters.h"
#include "mesh/mesh.h"

namespace toposcope {

/// A mesh of few faces that stands for one of many.
struct CoarseMesh {
  Mesh mesh;
  Clusters clusters;  ///< of the fine mesh's vertices: cluster i is vertex i of `mesh`
};

/// Makes one vertex of each cluster of vertices, where their mean lies once the surface's bend is allowed for, so that
/// noise is averaged and nothing shrinks. The surface keeps its form: clusters that are no discs, or touch each other
/// twice, are split until all are. So a hole or a rod that is thinner than the edges of the rest stays. In
/// another order of the vertices it is the same mesh. Linear time.
/// \param faces  about so many there would be, were there no need to split
/// \return nothing where `mesh` has no more than twice as many, or its form does not allow for much fewer
std::optional<CoarseMesh> coarsen(const MeshView& mesh, std::size_t faces, Context& context);

}  // namespace toposcope
