// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "toposcope/mesh_view.h"

namespace toposcope {

/// How many faces a mesh would have, were all of it as coarse as three fifths of its surface are, where it has over
/// twice as many: one part is much finer than the rest. Nothing for even meshes, for few faces, and for those whose
/// surface is mostly of long thin triangles: what made them knew of flat faces and straight edges.
std::optional<std::size_t> even_face_count(const MeshView& mesh);

}  // namespace toposcope
