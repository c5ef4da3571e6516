// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mesh/clusters.h"
#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// The triangles between clusters: one for each face of the mesh whose corners lie in three of them.
struct ClusterFaces {
  std::vector<Triangle> triangles;  ///< of clusters, least corner first, ascending
  /// Clusters that cannot become one vertex each without changing the form of the surface, ascending: no disc (a piece
  /// around a rod, or with a hole), without a triangle, or with a neighbour that they touch in two places. With none
  /// the triangles are a manifold of the mesh's own topology.
  std::vector<Index> folded;
};

/// \pre a manifold with border, consistently oriented
ClusterFaces faces_between(const MeshView& mesh, const Clusters& clusters, Context& context);

}  // namespace toposcope
