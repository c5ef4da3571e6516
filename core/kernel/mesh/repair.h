// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mesh/mesh.h"
#include "mesh/repair_report.h"

namespace toposcope {

/// Makes of any triangles a consistently oriented manifold with border, as much like the input as can be. A clean mesh
/// stays as it is, index by index; otherwise vertices in other order give the same mesh in other order. Repairing twice
/// changes nothing more, unless sheets were taken apart in a way that the result does not tell (`notable`).
/// `face_origin` goes along. Near-linear time.
/// \throw MeshError  nothing is left, no face has an area, or most faces have a corner that is not finite
RepairReport repair(TriangleSoup& soup, const std::string& name);

}  // namespace toposcope
