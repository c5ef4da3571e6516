// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "toposcope/context.h"
#include "toposcope/types.h"

namespace toposcope {

/// For each vertex the number of its connected component, in the order of their least vertices. In parallel.
/// \param count  receives how many there are
std::vector<Index> connected_vertices(std::size_t vertices, std::span<const Triangle> triangles, Context* context,
                                      Index& count);

}  // namespace toposcope
