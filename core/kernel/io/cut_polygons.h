// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/mesh.h"

namespace toposcope {

/// Cuts anew what a fan cut blindly: of a face with four corners the diagonal is chosen, a face with more is cut by
/// ears in its plane (Meisters 1975, Polygons have ears), so that concave ones do not fold. No corner is left out, and
/// a face of n corners stays n - 2 triangles at the same places. \pre  triangles of the same `face_origin` follow each
/// other as the fan of their polygon; indices are in range
void cut_polygons(TriangleSoup& soup);

}  // namespace toposcope
