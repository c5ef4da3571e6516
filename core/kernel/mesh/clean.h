// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mesh/gluing.h"
#include "mesh/mesh.h"
#include "mesh/repair_report.h"

namespace toposcope {

/// The faces by the places of their corners, and how they hang together.
struct Cleaned {
  std::vector<Index> first;      ///< for each vertex the one that stands for its place
  std::vector<Triangle> welded;  ///< corners by these
  Gluing gluing;
};

/// Drops faces that are not there, twice there or not finite, and joins vertices at one place where the surface is
/// open: seams and separate triangles close, and what is closed already stays as it is.
/// \param report  is told what was dropped
/// \throw MeshError  nothing is left, or most faces have a corner that is not finite
Cleaned clean(TriangleSoup& soup, const std::string& name, RepairReport& report);

}  // namespace toposcope
