// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/errors.h"
#include "toposcope/geometry/large_array.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

constexpr std::size_t grain = 1 << 16;

/// Beyond these extents squares of lengths and their products leave the range of a double.
constexpr double smallest_extent = 1e-75;
constexpr double largest_extent = 1e75;

/// \throw MeshError  always: of the first vertex or triangle that is not as it must be
[[noreturn]] void find_fault(const TriangleSoup& soup, const std::string& name) {
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
  throw std::logic_error(name + ": a fault that is none");
}

void check(const TriangleSoup& soup, const std::string& name, Context* context) {
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
  // In parallel it is only seen that something is wrong; what is wrong first is then found in order.
  std::atomic<bool> wrong = false;
  for_chunks(context, soup.positions.size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      if (!soup.positions[v].allFinite()) wrong = true;
  });
  for_chunks(context, soup.triangles.size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const auto& [a, b, c] = soup.triangles[f];
      if (std::max({a, b, c}) >= soup.positions.size() || soup.face_origin[f] >= soup.input_faces) wrong = true;
    }
  });
  if (wrong) find_fault(soup, name);
}

bool repeats_a_vertex(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void drop_degenerate(TriangleSoup& soup, const std::string& name) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    if (repeats_a_vertex(soup.triangles[f])) continue;
    soup.triangles[kept] = soup.triangles[f];
    soup.face_origin[kept++] = soup.face_origin[f];
  }
  if (kept == 0) throw MeshError(name + ": every face repeats a vertex, nothing is left of the surface");
  soup.triangles.resize(kept);
  soup.face_origin.resize(kept);
}

/// Only vertices that a face uses belong to the object.
Box box_of_surface(const TriangleSoup& soup, const Rows& faces, const std::string& name) {
  std::vector<Vec3> used;
  reserve_large(used, soup.positions.size());
  for (std::size_t v = 0; v < soup.positions.size(); ++v)
    if (faces.offsets[v] != faces.offsets[v + 1]) used.push_back(soup.positions[v]);
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

Mesh::Mesh(TriangleSoup soup, const std::string& name, Context* context) : soup_(std::move(soup)) {
  check(soup_, name, context);
  if (std::any_of(soup_.triangles.begin(), soup_.triangles.end(), repeats_a_vertex)) drop_degenerate(soup_, name);
  faces_ = faces_around_vertices(soup_.positions.size(), soup_.triangles, context);
  OneRings rings = one_rings(soup_.positions, soup_.triangles, faces_, context,
                             [&] { view_.box = box_of_surface(soup_, faces_, name); });
  neighbors_ = std::move(rings.rows);
  view_.positions = soup_.positions;
  view_.triangles = soup_.triangles;
  view_.neighbor_offsets = neighbors_.offsets;
  view_.neighbors = neighbors_.entries;
  view_.face_offsets = faces_.offsets;
  view_.faces = faces_.entries;
  view_.mean_edge = rings.mean_edge;
  view_.input_vertices = soup_.input_vertices;
}

}  // namespace toposcope
