// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace toposcope::bench {

// Other libraries' readers, each in a file of its own. All return the number of faces, 0 on failure.
std::size_t read_openmesh(const std::string& file);
std::size_t read_cgal(const std::string& file);
std::size_t read_vtk(const std::string& file);

}  // namespace toposcope::bench
