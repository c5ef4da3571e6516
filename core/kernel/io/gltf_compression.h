// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_document.h"

namespace toposcope {

/// The bytes of a buffer view that is compressed with meshopt.
/// \param extension   EXT_meshopt_compression of the view: count, byteStride, mode, filter
/// \param compressed  the bytes that it names
/// \throw MeshError  damaged, out of proportion, or of a newer version
std::string decode_meshopt(const GltfValue& extension, std::string_view compressed);

/// A primitive that is compressed with Draco.
struct DracoPrimitive {
  std::vector<double> positions;  ///< three for each vertex
  std::vector<double> indices;    ///< three for each triangle
};

/// \param extension   KHR_draco_mesh_compression of the primitive: attributes
/// \param compressed  the bytes of its buffer view
/// \throw MeshError  damaged, out of proportion, or this program was built without Draco
DracoPrimitive decode_draco(const GltfValue& extension, std::string_view compressed);

}  // namespace toposcope
