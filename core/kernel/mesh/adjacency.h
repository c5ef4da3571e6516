// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "toposcope/context.h"
#include "toposcope/types.h"

namespace toposcope {

/// A loop over chunks: in parallel with a context, in order without one.
void for_chunks(Context* context, std::size_t count, std::size_t grain,
                const std::function<void(std::size_t first, std::size_t last)>& body);

/// Compressed rows: those of vertex v are [offsets[v], offsets[v + 1]).
struct Rows {
  std::vector<Index> offsets, entries;
};

/// Faces around each vertex, ascending. Work proportional to the mesh.
/// \pre indices in range
Rows faces_around_vertices(std::size_t vertices, std::span<const Triangle> triangles, Context* context);

struct OneRings {
  Rows rows;             ///< neighbours of each vertex, ascending, each once
  double mean_edge = 0;  ///< mean length of the undirected edges
};

/// \param beside  further work to be done meanwhile
/// \pre no triangle repeats a vertex
OneRings one_rings(std::span<const Vec3> positions, std::span<const Triangle> triangles, const Rows& faces,
                   Context* context, const std::function<void()>& beside);

}  // namespace toposcope
