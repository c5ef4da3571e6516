// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <fstream>

#include "rivals.h"

namespace toposcope::bench {

std::size_t read_cgal(const std::string& file) {
  CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> mesh;
  std::ifstream stream(file, std::ios::binary);
  return CGAL::IO::read_PLY(stream, mesh) ? mesh.number_of_faces() : 0;
}

}  // namespace toposcope::bench
