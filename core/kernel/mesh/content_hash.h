// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mesh/mesh.h"

namespace toposcope {

/// SHA-256 of a mesh's positions and triangles and of the face of the file that each comes from, in hexadecimal: what
/// tells whether a result speaks of this mesh. The same whatever the file is called and in whatever format it is, where
/// the format keeps positions and order.
std::string content_hash(const Mesh& mesh);

}  // namespace toposcope
