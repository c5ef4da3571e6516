// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/gltf_document.h"

namespace toposcope {

/// The bytes of "data:...;base64,...". \param place  for messages \throw MeshError
std::string decode_data_uri(const GltfValue& place, std::string_view uri);

/// The file that a relative URI names: in the folder or below it, also after symbolic links are followed.
/// \param place  for messages \throw MeshError
std::filesystem::path path_of_uri(const GltfValue& place, std::string_view uri, const std::filesystem::path& folder);

}  // namespace toposcope
