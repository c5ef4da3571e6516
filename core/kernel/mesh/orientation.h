// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "mesh/gluing.h"

namespace toposcope {

/// Connected faces of one orientation.
struct Components {
  std::vector<Index> of_face;
  Index count = 0;
  Index turned_faces = 0;  ///< whose last two corners were exchanged
  Index cut_edges = 0;     ///< whose faces could not be made to agree: a surface with one side
};

/// Turns faces over until glued ones run along their edge in opposite directions, and cuts where that cannot be. Of the
/// two ways that are left for each component: a closed one, or one whose holes are small against it, gets its outside
/// outside; a closed one that the file has consistently inside out and that lies within another closed one is a cavity
/// and stays; any other is turned as most of its faces are in the file. \param triangles  turned as said \param
/// mirrored   corners of the same faces, turned alike
Components orient(std::span<const Vec3> positions, std::span<Triangle> triangles, std::span<Triangle> mirrored,
                  Gluing& gluing);

}  // namespace toposcope
