// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sample/isosurface.h"

namespace toposcope {

/// Fills in nodes until no two cells' faces meet in an edge or a corner alone: the set of nodes inside is well-composed
/// (Latecki 1997), and the surface net about it is a manifold. Nodes only change from outside to inside, those nearest
/// to the surface first.
void make_well_composed(NodeGrid& grid);

}  // namespace toposcope
