// SPDX-License-Identifier: BSD-3-Clause
#include "scene/display_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <map>
#include <queue>

#include "toposcope/geometry/half_edges.h"

namespace toposcope {
namespace {

/// Corners as meshoptimizer takes them: a vertex where labels meet is one corner for each of them, so that it takes
/// the line between labels for a seam of attributes, and keeps it.
struct Corners {
  std::vector<std::array<float, 3>> positions;
  std::vector<Index> vertex;  // of each corner
  std::vector<std::uint8_t> label;
  std::vector<unsigned> indices;
};

Corners corners_of(const MeshView& mesh, std::span<const std::uint8_t> labels) {
  Corners corners;
  corners.indices.reserve(3 * mesh.triangles.size());
  std::vector<Index> first(mesh.vertex_count(), no_index);  // the corner of a vertex's first label
  std::map<std::pair<Index, std::uint8_t>, Index> further;
  const auto add = [&](Index v, std::uint8_t label) {
    // In units of the box about its centre: single numbers of ordinary size.
    const Vec3 p = (mesh.positions[v] - mesh.box.center) / mesh.box.diagonal();
    corners.positions.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    corners.vertex.push_back(v);
    corners.label.push_back(label);
    return static_cast<Index>(corners.vertex.size() - 1);
  };
  for (Index t = 0; t < mesh.face_count(); ++t) {
    const std::uint8_t label = labels.empty() ? std::uint8_t{0} : labels[t];
    for (const Index v : mesh.triangles[t]) {
      Index corner = first[v];
      if (corner == no_index) {
        corner = first[v] = add(v, label);
      } else if (corners.label[corner] != label) {
        const auto [place, is_new] = further.try_emplace({v, label}, no_index);
        if (is_new) place->second = add(v, label);
        corner = place->second;
      }
      corners.indices.push_back(corner);
    }
  }
  return corners;
}

/// For each vertex of the mesh the shown vertex nearest to it along the edges.
std::vector<Index> nearest_shown(const MeshView& mesh, const std::vector<Index>& vertex_ids) {
  std::vector<Index> shown_as(mesh.vertex_count(), no_index);
  std::vector<double> distance(mesh.vertex_count(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (Index s = 0; s < vertex_ids.size(); ++s) {
    shown_as[vertex_ids[s]] = s;
    distance[vertex_ids[s]] = 0;
    queue.emplace(0, vertex_ids[s]);
  }
  while (!queue.empty()) {
    const auto [reached, v] = queue.top();
    queue.pop();
    if (reached > distance[v]) continue;
    for (const Index w : mesh.one_ring(v)) {
      const double further = reached + (mesh.positions[w] - mesh.positions[v]).norm();
      if (!(further < distance[w])) continue;
      distance[w] = further;
      shown_as[w] = shown_as[v];
      queue.emplace(further, w);
    }
  }
  return shown_as;
}

/// Of the triangles around the corners of a shown triangle that carry its label, the one nearest to its middle.
Index triangle_behind(const MeshView& mesh, std::span<const std::uint8_t> labels, const Triangle& shown,
                      std::uint8_t label) {
  const Vec3 middle = (mesh.positions[shown[0]] + mesh.positions[shown[1]] + mesh.positions[shown[2]]) / 3;
  Index best = no_index;
  double least = std::numeric_limits<double>::infinity();
  for (const Index v : shown)
    for (const Index t : mesh.faces_of(v)) {
      if (!labels.empty() && labels[t] != label) continue;
      const auto& [a, b, c] = mesh.triangles[t];
      const double d = ((mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3 - middle).squaredNorm();
      if (d < least) least = d, best = t;
    }
  return best;
}

}  // namespace

std::vector<Index> DisplayMesh::shown(std::span<const Index> vertices) const {
  std::vector<Index> list(vertices.begin(), vertices.end());
  if (!shown_as.empty()) {
    for (Index& v : list) v = shown_as[v];
    std::erase(list, no_index);
  }
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

DisplayMesh display_mesh(const MeshView& mesh, std::span<const std::uint8_t> labels, std::size_t limit) {
  DisplayMesh display;
  display.mesh_vertices = mesh.vertex_count();
  display.mesh_triangles = mesh.face_count();
  if (mesh.triangles.size() <= limit) {
    display.positions.assign(mesh.positions.begin(), mesh.positions.end());
    display.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    display.labels.assign(labels.begin(), labels.end());
    return display;
  }
  const Corners corners = corners_of(mesh, labels);
  std::vector<unsigned> kept(corners.indices.size());
  kept.resize(meshopt_simplify(kept.data(), corners.indices.data(), corners.indices.size(),
                               corners.positions.front().data(), corners.positions.size(), sizeof(float[3]), 3 * limit,
                               1.0F, 0, nullptr));
  std::vector<Index> number(mesh.vertex_count(), no_index);
  for (std::size_t i = 0; i + 3 <= kept.size(); i += 3) {
    const Triangle whole = {corners.vertex[kept[i]], corners.vertex[kept[i + 1]], corners.vertex[kept[i + 2]]};
    const std::uint8_t label = corners.label[kept[i]];
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      Index& shown = number[whole[k]];
      if (shown == no_index) {
        shown = static_cast<Index>(display.positions.size());
        display.positions.push_back(mesh.positions[whole[k]]);
        display.vertex_ids.push_back(whole[k]);
      }
      triangle[k] = shown;
    }
    display.triangles.push_back(triangle);
    if (!labels.empty()) display.labels.push_back(label);
    display.faces.push_back(triangle_behind(mesh, labels, whole, label));
  }
  display.shown_as = nearest_shown(mesh, display.vertex_ids);
  return display;
}

}  // namespace toposcope
