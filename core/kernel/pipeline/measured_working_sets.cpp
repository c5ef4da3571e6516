// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/measured_working_sets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

#include "toposcope/geometry/curvature.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

constexpr std::size_t grain = 8;

BitMatrix overlaps(const WorkingSets& sets, Index vertex_count) {
  // Sets that hold each vertex, in compressed rows.
  std::vector<Index> offsets(vertex_count + 1, 0);
  for (Index v : sets.vertices) ++offsets[v + 1];
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<Index> holders(sets.vertices.size());
  std::vector<Index> next(offsets.begin(), offsets.end() - 1);
  for (Index s = 0; s < sets.size(); ++s)
    for (Index v : sets[s]) holders[next[v]++] = s;

  BitMatrix shared(sets.size());
  std::span<const Index> previous;
  for (Index v = 0; v < vertex_count; ++v) {
    const std::span<const Index> row = std::span(holders).subspan(offsets[v], offsets[v + 1] - offsets[v]);
    // Most vertices are held by the same sets as the one before.
    if (std::equal(row.begin(), row.end(), previous.begin(), previous.end())) continue;
    previous = row;
    for (Index a : row)
      for (Index b : row) shared.set(a, b);
  }
  return shared;
}

std::vector<Box> boxes_of(const WorkingSets& sets, const std::vector<std::string>& types, const MeshView& mesh,
                          Context& context) {
  std::vector<char> asked(sets.type_names.size(), 0);
  for (std::size_t t = 0; t < asked.size(); ++t)
    if (std::find(types.begin(), types.end(), sets.type_names[t]) != types.end()) asked[t] = 1;
  std::vector<Box> boxes(sets.size());
  context.parallel_for(sets.size(), grain, [&](std::size_t first, std::size_t last) {
    std::vector<Vec3> points;
    for (std::size_t s = first; s < last; ++s) {
      if (asked[sets.types[s]] == 0) continue;
      points.clear();
      for (Index v : sets[s]) points.push_back(mesh.positions[v]);
      boxes[s] = oriented_box(points);
    }
  });
  return boxes;
}

std::vector<double> edges_of(const WorkingSets& sets, const MeshView& mesh, Context& context) {
  std::vector<double> lengths(mesh.neighbors.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    for (Index i = mesh.neighbor_offsets[v]; i < mesh.neighbor_offsets[v + 1]; ++i)
      lengths[i] = (mesh.positions[mesh.neighbors[i]] - mesh.positions[v]).norm();
  std::vector<double> edges(sets.size(), 0);
  context.parallel_for(sets.size(), 4 * grain, [&](std::size_t first, std::size_t last) {
    std::vector<Index> inside(mesh.vertex_count(), 0);  // the set that holds a vertex, from 1
    for (std::size_t s = first; s < last; ++s) {
      const Index mark = static_cast<Index>(s - first) + 1;
      for (const Index v : sets[s]) inside[v] = mark;
      double sum = 0, count = 0;
      for (const Index v : sets[s])
        for (Index i = mesh.neighbor_offsets[v]; i < mesh.neighbor_offsets[v + 1]; ++i) {
          if (inside[mesh.neighbors[i]] != mark) continue;
          sum += lengths[i];
          ++count;
        }
      if (count > 0) edges[s] = sum / count;
    }
  });
  return edges;
}

std::vector<double> areas_of(const MeshView& mesh) {
  std::vector<double> areas(mesh.vertex_count(), 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const double third =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).norm() / 6;
    for (Index v : {a, b, c}) areas[v] += third;
  }
  return areas;
}

}  // namespace

MeasuredWorkingSets::MeasuredWorkingSets(WorkingSets sets, const std::vector<std::string>& asked, const MeshView& mesh,
                                         Context& context)
    : WorkingSets(std::move(sets)),
      overlap(overlaps(*this, mesh.vertex_count())),
      boxes(boxes_of(*this, asked, mesh, context)),
      edges(edges_of(*this, mesh, context)),
      vertex_areas(areas_of(mesh)),
      integrated_mean_curvature(mean_curvature_measure(mesh)) {}

void add_asked_types(const Model& model, std::vector<std::string>& types) {
  for (const ModelFeature& feature : model.features)
    for (const std::vector<std::string>* asked : {&feature.worksets, &feature.second_look})
      for (const std::string& type : *asked)
        if (std::find(types.begin(), types.end(), type) == types.end()) types.push_back(type);
}

}  // namespace toposcope
