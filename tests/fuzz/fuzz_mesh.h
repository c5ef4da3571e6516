// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "base/errors.h"
#include "io/mesh_io.h"
#include "mesh/repair.h"

namespace toposcope::fuzz {

/// What the program does with a file: read, repair, check, build adjacency. Anything but a mesh or a MeshError is a
/// finding.
inline int read_as(const char* name, const std::uint8_t* data, std::size_t size) {
  try {
    TriangleSoup soup = read_soup(std::string_view(reinterpret_cast<const char*>(data), size), name);
    repair(soup, name);
    const Mesh mesh(std::move(soup), name);
  } catch (const MeshError&) {
  }
  return 0;
}

}  // namespace toposcope::fuzz
