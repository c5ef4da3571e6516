// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/folded_clusters.h"

#include <algorithm>
#include <utility>

namespace toposcope {
namespace {

constexpr std::size_t face_grain = 1 << 14;

/// Edges from cluster to cluster, in compressed rows.
class DirectedEdges {
 public:
  DirectedEdges(Index clusters, std::span<const std::pair<Index, Index>> edges) : offsets_(clusters + 1, 0) {
    for (const auto& [from, to] : edges) ++offsets_[from + 1];
    for (std::size_t c = 1; c < offsets_.size(); ++c) offsets_[c] += offsets_[c - 1];
    to_.resize(edges.size());
    std::vector<Index> next(offsets_.begin(), offsets_.end() - 1);
    for (const auto& [from, to] : edges) to_[next[from]++] = to;
    for (Index c = 0; c < clusters; ++c) std::sort(to_.begin() + offsets_[c], to_.begin() + offsets_[c + 1]);
  }
  std::span<const Index> from(Index cluster) const {
    return std::span(to_).subspan(offsets_[cluster], offsets_[cluster + 1] - offsets_[cluster]);
  }
  bool has(Index from_cluster, Index to) const {
    const std::span<const Index> row = from(from_cluster);
    return std::binary_search(row.begin(), row.end(), to);
  }

 private:
  std::vector<Index> offsets_, to_;
};

/// What the faces say of the clusters.
struct FaceCounts {
  std::vector<Triangle> triangles;  ///< between three clusters
  std::vector<std::int32_t> euler;  ///< per cluster, twice the faces within it less the sides of faces within it
};

FaceCounts count_faces(const MeshView& mesh, const Clusters& clusters, Context& context) {
  const std::size_t chunk = std::max<std::size_t>(face_grain, mesh.face_count() / 8);
  std::vector<FaceCounts> parts((mesh.face_count() + chunk - 1) / chunk);
  context.parallel_for(mesh.face_count(), chunk, [&](std::size_t first, std::size_t last) {
    FaceCounts& part = parts[first / chunk];
    part.euler.assign(clusters.size(), 0);
    for (std::size_t f = first; f < last; ++f) {
      const auto& [i, j, k] = mesh.triangles[f];
      Triangle t{clusters.of[i], clusters.of[j], clusters.of[k]};
      if (t[0] == t[1] || t[2] == t[0]) {  // one side within, or all of it: twice one less three
        --part.euler[t[0]];
      } else if (t[1] == t[2]) {
        --part.euler[t[1]];
      } else {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        part.triangles.push_back(t);
      }
    }
  });
  FaceCounts all = std::move(parts.front());
  for (std::size_t p = 1; p < parts.size(); ++p) {
    all.triangles.insert(all.triangles.end(), parts[p].triangles.begin(), parts[p].triangles.end());
    for (std::size_t c = 0; c < all.euler.size(); ++c) all.euler[c] += parts[p].euler[c];
  }
  std::sort(all.triangles.begin(), all.triangles.end());
  return all;
}

/// Along the border of the mesh as its faces turn, as edges from cluster to cluster.
std::vector<std::pair<Index, Index>> border_edges(const MeshView& mesh, const Clusters& clusters) {
  std::vector<std::pair<Index, Index>> edges;
  for (const Index v : clusters.vertices) {
    const std::span<const Index> faces = mesh.faces_of(v);
    if (mesh.one_ring(v).size() == faces.size()) continue;
    const auto corner = [&](Index f, std::size_t step) {
      const Triangle& t = mesh.triangles[f];
      return t[((t[0] == v ? 0 : t[1] == v ? 1 : 2) + step) % 3];
    };
    for (const Index f : faces) {
      const Index to = corner(f, 1);
      if (std::none_of(faces.begin(), faces.end(), [&](Index other) { return corner(other, 2) == to; }))
        edges.emplace_back(clusters.of[v], clusters.of[to]);
    }
  }
  return edges;
}

}  // namespace

ClusterFaces faces_between(const MeshView& mesh, const Clusters& clusters, Context& context) {
  ClusterFaces result;
  auto [triangles, euler] = count_faces(mesh, clusters, context);
  result.triangles = std::move(triangles);
  std::vector<std::pair<Index, Index>> sides, border_sides;
  for (const Triangle& t : result.triangles)
    for (std::size_t k = 0; k < 3; ++k) sides.emplace_back(t[k], t[(k + 1) % 3]);
  // An edge within a cluster is a side of two faces, or of one and of the border.
  for (const auto& [from, to] : border_edges(mesh, clusters))
    if (from == to)
      --euler[from];
    else
      border_sides.emplace_back(from, to);
  const DirectedEdges edges(clusters.size(), sides), border(clusters.size(), border_sides);
  std::vector<char> folded(clusters.size(), 0);
  for (Index c = 0; c < clusters.size(); ++c) {
    euler[c] += 2 * static_cast<std::int32_t>(clusters[c].size());
    if (edges.from(c).empty() || euler[c] != 2) folded[c] = 1;  // a disc's vertices less edges plus faces are 1
  }
  // An edge has one triangle on either side, or one and the border of the mesh.
  for (Index c = 0; c < clusters.size(); ++c)
    for (const DirectedEdges* each : {&edges, &border}) {
      const std::span<const Index> row = each->from(c);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const bool twice = i > 0 && row[i] == row[i - 1];
        const bool sound = edges.has(c, row[i]) && edges.has(row[i], c) != border.has(c, row[i]);
        if (twice || !sound) folded[c] = folded[row[i]] = 1;
      }
    }
  for (Index c = 0; c < clusters.size(); ++c)
    if (folded[c] != 0) result.folded.push_back(c);
  return result;
}

}  // namespace toposcope
