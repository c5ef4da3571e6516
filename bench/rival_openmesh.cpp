// SPDX-License-Identifier: BSD-3-Clause
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "rivals.h"

namespace toposcope::bench {

std::size_t read_openmesh(const std::string& file) {
  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  return OpenMesh::IO::read_mesh(mesh, file) ? mesh.n_faces() : 0;
}

}  // namespace toposcope::bench
