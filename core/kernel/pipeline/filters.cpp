// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/filters.h"

#include <algorithm>
#include <numeric>

#include "mesh/evenness.h"
#include "plugin/guard.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

class SoupSink final : public MeshSink {
 public:
  void set(std::span<const Vec3> positions, std::span<const Triangle> triangles, std::span<const Index> face_origin,
           std::span<const Index> vertex_origin) override {
    result.emplace();
    result->positions.assign(positions.begin(), positions.end());
    result->triangles.assign(triangles.begin(), triangles.end());
    result->face_origin.assign(face_origin.begin(), face_origin.end());
    result->input_vertices.assign(vertex_origin.begin(), vertex_origin.end());
  }
  std::optional<TriangleSoup> result;
};

/// From vertices of the filter's input to vertices of the mesh that was read.
void carry_on(TriangleSoup& soup, const MeshView& input, const std::string& filter) {
  std::vector<Index>& origin = soup.input_vertices;
  if (origin.empty()) origin.assign(soup.positions.size(), no_vertex);
  if (origin.size() != soup.positions.size())
    throw PluginError(filter, "gave " + std::to_string(origin.size()) + " vertex origins for " +
                                  std::to_string(soup.positions.size()) + " vertices");
  for (std::size_t v = 0; v < origin.size(); ++v) {
    if (origin[v] == no_vertex) continue;
    if (origin[v] >= input.vertex_count() || input.positions[origin[v]] != soup.positions[v])
      throw PluginError(filter, "says that vertex " + std::to_string(v) + " is vertex " + std::to_string(origin[v]) +
                                    " of its input, which does not lie there");
    if (!input.input_vertices.empty()) origin[v] = input.input_vertices[origin[v]];
  }
}

void apply(std::span<const FilterStation> filters, PreparedMesh& prepared, Context& context) {
  prepared.origin = large_array<Index>(prepared.base().face_count());
  std::iota(prepared.origin.begin(), prepared.origin.end(), 0);
  for (const FilterStation& station : filters) {
    SoupSink sink;
    const Index faces = prepared.view().face_count();
    guard(station.id, [&] { station.plugin->apply(prepared.view(), context, sink); });
    if (!sink.result) continue;
    TriangleSoup& soup = *sink.result;
    if (soup.face_origin.size() != soup.triangles.size() ||
        std::any_of(soup.face_origin.begin(), soup.face_origin.end(), [&](Index f) { return f >= faces; }))
      throw PluginError(station.id, "gave a mesh whose faces do not say which input face they come from");
    soup.input_faces = faces;
    carry_on(soup, prepared.view(), station.id);
    Mesh next(std::move(soup), "the mesh made by filter '" + station.id + "'", &context);
    std::vector<Index> origin;
    origin.reserve(next.face_origin().size());
    for (Index f : next.face_origin()) origin.push_back(prepared.origin[f]);
    prepared.origin = std::move(origin);
    prepared.filtered = std::move(next);
  }
}

/// Triangles of the base of which at least half of the pieces are wanted; where there are none, those of which some
/// are: what is wanted is narrower than a triangle, an edge of it.
std::vector<Index> base_triangles(const PreparedMesh& prepared, const std::vector<bool>& which) {
  std::vector<std::int32_t> balance(prepared.base().face_count(), 0);
  std::vector<bool> touched(balance.size(), false);
  for (Index f = 0; f < prepared.view().face_count(); ++f) {
    balance[prepared.origin[f]] += which[f] ? 1 : -1;
    if (which[f]) touched[prepared.origin[f]] = true;
  }
  std::vector<Index> triangles;
  for (Index t = 0; t < balance.size(); ++t)
    if (touched[t] && balance[t] >= 0) triangles.push_back(t);
  if (!triangles.empty()) return triangles;
  for (Index t = 0; t < balance.size(); ++t)
    if (touched[t]) triangles.push_back(t);
  return triangles;
}

}  // namespace

void PreparedMesh::add_input_vertices(Index vertex, std::vector<Index>& vertices) const {
  const std::span<const Index> kept = view().input_vertices;
  const Index at = kept.empty() ? vertex : kept[vertex];
  if (at == no_vertex) return;
  if (!coarse) return vertices.push_back(at);
  const std::span<const Index> cluster = coarse->clusters[at];
  vertices.insert(vertices.end(), cluster.begin(), cluster.end());
}

std::vector<Index> PreparedMesh::input_triangles(const std::vector<bool>& which) const {
  std::vector<Index> triangles = base_triangles(*this, which);
  if (!coarse) return triangles;
  std::vector<Index> around(base().vertex_count(), 0);
  for (const Index t : triangles)
    for (const Index v : base().triangles[t]) ++around[v];
  const auto inside = [&](Index cluster) { return 2 * around[cluster] >= base().faces_of(cluster).size(); };
  const MeshView& fine = input->view();
  triangles.clear();
  for (Index cluster = 0; cluster < around.size(); ++cluster) {
    if (around[cluster] == 0 || !inside(cluster)) continue;
    for (const Index v : coarse->clusters[cluster])
      for (const Index f : fine.faces_of(v)) {
        const Triangle& t = fine.triangles[f];
        const auto within = [&](Index corner) { return inside(coarse->clusters.of[corner]) ? 1 : 0; };
        if (within(t[0]) + within(t[1]) + within(t[2]) >= 2) triangles.push_back(f);
      }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

PreparedMesh apply_filters(const Mesh& mesh, std::span<const FilterStation> filters, Context& context) {
  PreparedMesh prepared;
  prepared.input = &mesh;
  apply(filters, prepared, context);
  return prepared;
}

PreparedMesh prepare_mesh(const Mesh& mesh, const Stations& stations, Context& context) {
  PreparedMesh prepared;
  prepared.input = &mesh;
  if (stations.resolution.faces > 0) {
    prepared.coarse = coarsen(mesh.view(), stations.resolution.faces, context);
    if (!prepared.coarse)
      if (const auto faces = even_face_count(mesh.view())) prepared.coarse = coarsen(mesh.view(), *faces, context);
  }
  apply(stations.filters, prepared, context);
  return prepared;
}

}  // namespace toposcope
