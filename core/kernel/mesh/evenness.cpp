// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/evenness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <vector>

namespace toposcope {
namespace {

constexpr double part = 0.6;         // of the surface
constexpr double uneven = 2.2;       // times as many faces
constexpr double well_shaped = 0.4;  // an equilateral triangle has 1
constexpr std::size_t fewest = 600;

}  // namespace

std::optional<std::size_t> even_face_count(const MeshView& mesh) {
  if (mesh.face_count() < uneven * fewest) return std::nullopt;
  std::vector<double> areas;
  areas.reserve(mesh.face_count());
  double shape = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 u = mesh.positions[b] - mesh.positions[a], v = mesh.positions[c] - mesh.positions[a];
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
    const double area = u.cross(v).norm() / 2;
    areas.push_back(area);
    if (longest > 0) shape += area * area / longest;
  }
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  constexpr double equilateral = 2.309401;  // squared side per area
  if (!(equilateral * shape > well_shaped * total)) return std::nullopt;
  std::sort(areas.begin(), areas.end());
  double sum = 0;
  const auto typical =
      std::find_if(areas.begin(), areas.end(), [&](double area) { return (sum += area) >= part * total; });
  const double count = total / *typical;
  if (count < fewest || uneven * count > mesh.face_count()) return std::nullopt;
  return static_cast<std::size_t>(count);
}

}  // namespace toposcope
