// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/filters.h"

#include <algorithm>
#include <numeric>

#include "plugin/guard.h"

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

}  // namespace

PreparedMesh apply_filters(const Mesh& mesh, std::span<const FilterStation> filters, Context& context) {
  PreparedMesh prepared;
  prepared.input = &mesh;
  prepared.origin.resize(mesh.view().face_count());
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
  return prepared;
}

}  // namespace toposcope
