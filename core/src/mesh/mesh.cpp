// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/errors.h"
#include "toposcope/geometry.h"

namespace toposcope {
namespace {

/// Beyond these extents squares of lengths and their products leave the range of a double.
constexpr double smallest_extent = 1e-75;
constexpr double largest_extent = 1e75;

void check(const TriangleSoup& soup, const std::string& name) {
  const std::size_t limit = std::numeric_limits<Index>::max() / 6;  // six directed edges a face
  if (soup.positions.empty()) throw MeshError(name + ": no vertex; is this the right file?");
  if (soup.triangles.empty())
    throw MeshError(name + ": " + std::to_string(soup.positions.size()) +
                    " vertices but no face with three corners; a point cloud has to be meshed first");
  if (soup.positions.size() > limit || soup.triangles.size() > limit)
    throw MeshError(name + ": more than " + std::to_string(limit) + " vertices or faces; decimate the mesh first");
  if (soup.face_origin.size() != soup.triangles.size())
    throw MeshError(name + ": " + std::to_string(soup.triangles.size()) + " triangles but " +
                    std::to_string(soup.face_origin.size()) + " face origins; give one origin for each triangle");
  for (std::size_t v = 0; v < soup.positions.size(); ++v)
    if (!soup.positions[v].allFinite())
      throw MeshError(name + ": vertex " + std::to_string(v) +
                      " (from 0) has a coordinate that is not a finite number; remove or repair it");
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    for (Index v : soup.triangles[f])
      if (v >= soup.positions.size())
        throw MeshError(name + ": triangle " + std::to_string(f) + " (from 0) refers to vertex " + std::to_string(v) +
                        " but there are " + std::to_string(soup.positions.size()) + " (indices are from 0)");
    if (soup.face_origin[f] >= soup.input_faces)
      throw MeshError(name + ": triangle " + std::to_string(f) + " (from 0) has face origin " +
                      std::to_string(soup.face_origin[f]) + " but the input has " + std::to_string(soup.input_faces) +
                      " faces");
  }
}

void drop_degenerate(TriangleSoup& soup, const std::string& name) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    const auto& [a, b, c] = soup.triangles[f];
    if (a == b || b == c || c == a) continue;
    soup.triangles[kept] = soup.triangles[f];
    soup.face_origin[kept++] = soup.face_origin[f];
  }
  if (kept == 0) throw MeshError(name + ": every face repeats a vertex, nothing is left of the surface");
  soup.triangles.resize(kept);
  soup.face_origin.resize(kept);
}

/// Faces around each vertex, by counting sort: rows come out ascending.
void build_face_rows(const TriangleSoup& soup, std::vector<Index>& offsets, std::vector<Index>& faces) {
  offsets.assign(soup.positions.size() + 1, 0);
  for (const Triangle& t : soup.triangles)
    for (Index v : t) ++offsets[v + 1];
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  faces.resize(3 * soup.triangles.size());
  std::vector<Index> next(offsets.begin(), offsets.end() - 1);
  for (Index f = 0; f < soup.triangles.size(); ++f)
    for (Index v : soup.triangles[f]) faces[next[v]++] = f;
}

/// One-rings in linear time: "w is a neighbour of v" is symmetric, so visiting v in ascending order and appending v
/// to the row of each w fills every row in ascending order, and a repeated v is always the row's last entry.
void build_one_rings(const TriangleSoup& soup, const std::vector<Index>& face_offsets, const std::vector<Index>& faces,
                     std::vector<Index>& offsets, std::vector<Index>& neighbors) {
  const Index count = static_cast<Index>(soup.positions.size());
  neighbors.resize(6 * soup.triangles.size());  // a vertex of k faces has at most 2k neighbours
  std::vector<Index> length(count, 0);
  for (Index v = 0; v < count; ++v)
    for (Index i = face_offsets[v]; i < face_offsets[v + 1]; ++i)
      for (Index w : soup.triangles[faces[i]]) {
        if (w == v) continue;
        Index* row = neighbors.data() + 2 * std::size_t{face_offsets[w]};
        if (length[w] == 0 || row[length[w] - 1] != v) row[length[w]++] = v;
      }
  offsets.assign(count + 1, 0);
  for (Index v = 0; v < count; ++v) {
    const Index* row = neighbors.data() + 2 * std::size_t{face_offsets[v]};
    for (Index i = 0; i < length[v]; ++i) neighbors[offsets[v] + i] = row[i];  // never ahead of what is still to come
    offsets[v + 1] = offsets[v] + length[v];
  }
  neighbors.resize(offsets.back());
  neighbors.shrink_to_fit();
}

double mean_edge_length(const MeshView& mesh) {
  double sum = 0;
  std::size_t count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    for (Index w : mesh.one_ring(v))
      if (v < w) {
        sum += (mesh.positions[w] - mesh.positions[v]).norm();
        ++count;
      }
  return sum / static_cast<double>(count);
}

/// Only vertices that a face uses belong to the object.
Box box_of_surface(const MeshView& mesh, const std::string& name) {
  std::vector<Vec3> used;
  used.reserve(mesh.positions.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.faces_of(v).empty()) used.push_back(mesh.positions[v]);
  Vec3 low = used.front(), high = used.front();
  for (const Vec3& p : used) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = (high / 2 - low / 2).maxCoeff() * 2;
  if (extent == 0) throw MeshError(name + ": the surface has no extent, all its vertices are at one place");
  if (!(extent >= smallest_extent && extent <= largest_extent))
    throw MeshError(name + ": the surface extends over " + std::to_string(extent) +
                    " units, outside of what can be computed with; rescale it");
  return oriented_box(used);
}

}  // namespace

Mesh::Mesh(TriangleSoup soup, const std::string& name) : soup_(std::move(soup)) {
  check(soup_, name);
  drop_degenerate(soup_, name);
  build_face_rows(soup_, face_offsets_, faces_);
  build_one_rings(soup_, face_offsets_, faces_, neighbor_offsets_, neighbors_);
  view_.positions = soup_.positions;
  view_.triangles = soup_.triangles;
  view_.neighbor_offsets = neighbor_offsets_;
  view_.neighbors = neighbors_;
  view_.face_offsets = face_offsets_;
  view_.faces = faces_;
  view_.box = box_of_surface(view_, name);
  view_.mean_edge = mean_edge_length(view_);
}

}  // namespace toposcope
