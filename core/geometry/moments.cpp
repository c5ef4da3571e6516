// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>

#include "neighbourhood.h"
#include "toposcope/curvature.h"

namespace toposcope {

std::vector<Vec3> first_moments(const MeshView& mesh, double reach, Context& context) {
  std::vector<double> areas(mesh.vertex_count(), 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const double area = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).norm();
    for (Index v : {a, b, c}) areas[v] += area;
  }
  std::vector<Vec3> moments(mesh.vertex_count(), Vec3::Zero());
  const std::size_t chunk = std::max<std::size_t>(1024, mesh.vertex_count() / 16);
  context.parallel_for(mesh.vertex_count(), chunk, [&](std::size_t first, std::size_t last) {
    Neighbourhood neighbourhood(mesh, reach);
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      Vec3 sum = Vec3::Zero();
      double area = areas[p];
      for (const Neighbour& q : neighbourhood.around(p)) {
        sum += areas[q.vertex] * q.offset;
        area += areas[q.vertex];
      }
      if (area > 0 && neighbourhood.radius() > 0) moments[p] = sum / (area * neighbourhood.radius());
    }
  });
  return moments;
}

}  // namespace toposcope
