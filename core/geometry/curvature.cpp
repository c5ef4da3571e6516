// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "find_half_edge.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

constexpr std::size_t grain = 1024;

Vec3 mean_face_normal(const MeshView& mesh, Index v) {
  Vec3 sum = Vec3::Zero();
  for (Index f : mesh.faces_of(v)) {
    const auto& [a, b, c] = mesh.triangles[f];
    sum += (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
  }
  return sum;
}

}  // namespace

std::vector<Vec3> plane_fit_normals(const MeshView& mesh, Context& context) {
  std::vector<Vec3> normals(mesh.vertex_count());
  context.parallel_for(mesh.vertex_count(), grain, [&](std::size_t first, std::size_t last) {
    std::vector<Vec3> points;
    for (Index v = static_cast<Index>(first); v < last; ++v) {
      const Vec3 outward = mean_face_normal(mesh, v);
      Vec3 normal = outward.stableNormalized();
      const auto ring = mesh.one_ring(v);
      if (ring.size() >= 2) {
        points.assign(1, mesh.positions[v]);
        for (Index q : ring) points.push_back(mesh.positions[q]);
        const PrincipalAxes axes = principal_axes(points);
        // A ring that lies on a line has no plane.
        if (axes.variance[1] > 1e-12 * axes.variance[0])
          normal = axes.axes[2].dot(outward) < 0 ? Vec3(-axes.axes[2]) : axes.axes[2];
      }
      normals[v] = normal;
    }
  });
  return normals;
}

Curvature turning_curvature(const MeshView& mesh, const std::vector<Vec3>& normals, int rings, Context& context) {
  Curvature curvature;
  curvature.maximum.resize(mesh.vertex_count());
  curvature.minimum.resize(mesh.vertex_count());
  // Few chunks: each has a mark per vertex of the mesh.
  const std::size_t chunk = std::max<std::size_t>(grain, mesh.vertex_count() / 16);
  context.parallel_for(mesh.vertex_count(), chunk, [&](std::size_t first, std::size_t last) {
    std::vector<Index> reached;  // breadth first from the vertex
    std::vector<Index> reached_from(mesh.vertex_count(), std::numeric_limits<Index>::max());
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      if (context.cancelled()) return;
      reached.assign(1, p);
      reached_from[p] = p;
      std::size_t ring_begin = 0;
      for (int ring = 0; ring < rings; ++ring) {
        const std::size_t ring_end = reached.size();
        for (std::size_t i = ring_begin; i < ring_end; ++i)
          for (Index q : mesh.one_ring(reached[i]))
            if (reached_from[q] != p) {
              reached_from[q] = p;
              reached.push_back(q);
            }
        ring_begin = ring_end;
      }
      double largest = -std::numeric_limits<double>::infinity();
      double smallest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 1; i < reached.size(); ++i) {
        const Vec3 chord = mesh.positions[p] - mesh.positions[reached[i]];
        const double length = chord.norm();
        if (length == 0) continue;
        const Vec3 turn = normals[p] - normals[reached[i]];
        const double kappa = std::copysign(turn.norm() / length, turn.dot(chord));
        largest = std::max(largest, kappa);
        smallest = std::min(smallest, kappa);
      }
      const bool alone = largest < smallest;
      curvature.maximum[p] = alone ? 0 : largest;
      curvature.minimum[p] = alone ? 0 : smallest;
    }
  });
  return curvature;
}

void smooth_over_ring(const MeshView& mesh, std::vector<double>& field, int passes, Context& context) {
  std::vector<double> smoothed(field.size());
  for (int pass = 0; pass < passes; ++pass) {
    context.parallel_for(field.size(), grain, [&](std::size_t first, std::size_t last) {
      for (Index v = static_cast<Index>(first); v < last; ++v) {
        const auto ring = mesh.one_ring(v);
        double sum = field[v];
        for (Index q : ring) sum += field[q];
        smoothed[v] = sum / static_cast<double>(ring.size() + 1);
      }
    });
    field.swap(smoothed);
  }
}

double surface_area(const MeshView& mesh) {
  double twice = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    twice += (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).norm();
  return twice / 2;
}

std::vector<double> mean_curvature_measure(const MeshView& mesh) {
  std::vector<Vec3> normals(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    normals[f] =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).stableNormalized();
  }
  std::vector<double> measure(mesh.vertex_count(), 0);
  for (Index a = 0; a < mesh.vertex_count(); ++a)
    for (Index b : mesh.one_ring(a)) {
      if (b < a) continue;
      const auto there = geometry::find_half_edge(mesh, a, b), back = geometry::find_half_edge(mesh, b, a);
      if (there.count != 1 || back.count != 1) continue;
      const Vec3 &left = normals[there.half_edge / 3], &right = normals[back.half_edge / 3];
      const Vec3 along = mesh.positions[b] - mesh.positions[a];
      const double length = along.norm();
      if (!(length > 0)) continue;
      const double sine = left.cross(right).dot(along) / length;
      const double share = length * std::atan2(sine, left.dot(right)) / 4;
      measure[a] += share;
      measure[b] += share;
    }
  return measure;
}

int rings_within(const MeshView& mesh, double radius) {
  return static_cast<int>(std::clamp(std::lround(radius / mesh.mean_edge), 1L, 8L));
}

}  // namespace toposcope
