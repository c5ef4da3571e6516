// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "neighbourhood.h"
#include "toposcope/geometry/curvature.h"

namespace toposcope {

std::vector<Vec3> first_moments(const MeshView& mesh, double reach, Context& context) {
  std::vector<double> areas(mesh.vertex_count(), 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const double area = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).norm();
    for (Index v : {a, b, c}) areas[v] += area;
  }
  const auto most_points = static_cast<std::size_t>(12 * reach * reach + 48);
  std::vector<Vec3> moments(mesh.vertex_count(), Vec3::Zero());
  const std::size_t chunk = std::max<std::size_t>(1024, mesh.vertex_count() / 16);
  context.parallel_for(mesh.vertex_count(), chunk, [&](std::size_t first, std::size_t last) {
    Neighbourhood neighbourhood(mesh, {.reach = reach, .last_step = 1, .most_points = most_points});
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      Vec3 sum = Vec3::Zero();
      double weight = areas[p];
      const std::span<const Neighbour> ball = neighbourhood.around(p);
      const double squared_radius = neighbourhood.radius() * neighbourhood.radius();
      for (const Neighbour& q : ball) {
        const double here = areas[q.vertex] * std::max(0.0, 1 - q.offset.squaredNorm() / squared_radius);
        sum += here * q.offset;
        weight += here;
      }
      if (!ball.empty() && weight > 0) moments[p] = sum / (weight * neighbourhood.radius());
    }
  });
  return moments;
}

}  // namespace toposcope
