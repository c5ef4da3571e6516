// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/errors.h"
#include "io/mesh_io.h"

namespace toposcope::fuzz {

/// What the program does with a file: read, check, build adjacency. Anything but a mesh or a MeshError is a finding.
inline int read_as(const char* name, const std::uint8_t* data, std::size_t size) {
  try {
    const Mesh mesh(read_soup(std::string_view(reinterpret_cast<const char*>(data), size), name), name);
  } catch (const MeshError&) {
  }
  return 0;
}

}  // namespace toposcope::fuzz
