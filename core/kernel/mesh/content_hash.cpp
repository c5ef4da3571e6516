// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/content_hash.h"

#include "base/sha256.h"

namespace toposcope {

std::string content_hash(const Mesh& mesh) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(Index), "hashed as they lie");
  const MeshView& view = mesh.view();
  Sha256 hash;
  hash.add(std::to_string(view.vertex_count()) + " " + std::to_string(view.face_count()) + " " +
           std::to_string(mesh.input_faces()) + "\n");
  hash.add(std::span<const Vec3>(view.positions));
  hash.add(std::span<const Triangle>(view.triangles));
  hash.add(mesh.face_origin());
  return hash.hex();
}

}  // namespace toposcope
