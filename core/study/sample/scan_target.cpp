// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sample/mesh_solid.h"
#include "sample/scan.h"
#include "toposcope/geometry/half_edges.h"

namespace toposcope {

namespace {

/// What is cut: edges whose middle is farther than `tolerance` from the surface, and edges from part to part that are
/// longer than `seam`.
struct Refinement {
  double tolerance = 0, seam = 0;
};

/// Cuts edges at their middle, which moves onto the surface. Every edge that a cut makes has a new vertex, so that
/// edges between vertices before `first_new` have been looked at.
void refine(TriangleSoup& mesh, const Solid& solid, double spacing, const Refinement& wanted, std::size_t first_new,
            Context& context) {
  struct Edge {
    Index from, to, half_edge;
    bool operator<(const Edge& other) const {
      return from != other.from ? from < other.from : to != other.to ? to < other.to : half_edge < other.half_edge;
    }
    bool same(const Edge& other) const { return from == other.from && to == other.to; }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (Index f = 0; f < mesh.triangles.size(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[f][k], b = mesh.triangles[f][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), 3 * f + k});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> parts(mesh.positions.size(), 0);
  if (solid.part_names.size() > 1)
    context.parallel_for(parts.size(), 4096, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) parts[v] = solid.part_of(mesh.positions[v]);
    });
  std::vector<Vec3> middles(edges.size());  // of the first of equal edges
  std::vector<char> cut(edges.size(), 0);
  context.parallel_for(edges.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (i > 0 && edges[i].same(edges[i - 1])) continue;
      const Index a = edges[i].from, b = edges[i].to;
      if (b < first_new) continue;
      const Vec3 middle = (mesh.positions[a] + mesh.positions[b]) / 2;
      const bool seam = parts[a] != parts[b] && (mesh.positions[a] - mesh.positions[b]).norm() > wanted.seam;
      if (!seam && std::abs(solid.surface(middle).value) <= wanted.tolerance) continue;
      cut[i] = 1;
      middles[i] = project(solid.surface, middle, spacing);
    }
  });
  std::vector<Index> new_vertex(edges.size(), no_index);  // by half-edge
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool again = i > 0 && edges[i].same(edges[i - 1]);
    if (cut[i] != 0) mesh.positions.push_back(middles[i]);
    if (cut[i] != 0) new_vertex[edges[i].half_edge] = static_cast<Index>(mesh.positions.size() - 1);
    if (again) new_vertex[edges[i].half_edge] = new_vertex[edges[i - 1].half_edge];
  }
  std::vector<Triangle> triangles;
  triangles.reserve(2 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    // The corners and new vertices in a row; ears are cut at the corners that lie between two new ones.
    std::array<Index, 6> around;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      around[count++] = mesh.triangles[f][k];
      if (new_vertex[3 * f + k] != no_index) around[count++] = new_vertex[3 * f + k];
    }
    if (count == 6) {
      const auto& [a, ab, b, bc, c, ca] = around;
      triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
      continue;
    }
    // From the new vertex that comes first, or any corner: a fan has no face without area.
    std::size_t start = 0;
    for (std::size_t k = 0; k < count; ++k)
      if (around[k] == new_vertex[3 * f] || around[k] == new_vertex[3 * f + 1] || around[k] == new_vertex[3 * f + 2]) {
        start = k;
        break;
      }
    for (std::size_t k = 1; k + 1 < count; ++k)
      triangles.push_back({around[start], around[(start + k) % count], around[(start + k + 1) % count]});
  }
  mesh.triangles = std::move(triangles);
}

/// Whether some vertex lies within `reach` of each feature, at eight of its points.
bool reaches(const TriangleSoup& mesh, const std::vector<TruthFeature>& features, double reach) {
  return std::all_of(features.begin(), features.end(), [&](const TruthFeature& feature) {
    const std::size_t step = std::max<std::size_t>(1, feature.points.size() / 8);
    for (std::size_t i = 0; i < feature.points.size(); i += step)
      if (std::none_of(mesh.positions.begin(), mesh.positions.end(),
                       [&](const Vec3& p) { return (p - feature.points[i]).squaredNorm() <= reach * reach; }))
        return false;
    return true;
  });
}

}  // namespace

Sample make_scan_target(const SampleRequest& request, Context& context) try {
  Sample sample;
  sample.truth.class_name = request.kind;
  sample.seed = request.seed;
  sample.parameters = requested_parameters(request);
  const Solid solid = make_solid(request.kind, sample.parameters);
  sample.gap = solid.gap;
  sample.thinnest = solid.thinnest;
  sample.truth.features = solid.features;
  if (solid.tessellate) {
    TessellatedSolid fine = solid.tessellate(true);
    sample.mesh = std::move(fine.mesh);
    sample.face_part = std::move(fine.face_part);
    sample.part_names = solid.part_names;
    return sample;
  }
  // The net may be coarse, as in make_sample: rays do not mind faces of uneven size.
  const double level = net_level(solid);
  const double diagonal = (solid.high - solid.low).norm();
  double spacing = std::min(0.55 * (solid.thinnest + 2 * level), 0.02 * diagonal);
  const double fine = diagonal * std::min(1.0, std::sqrt(20000.0 / request.faces));
  const Refinement wanted{.tolerance = 0.0004 * fine, .seam = 0.004 * fine};
  // A part that is narrower than a cell is missed, and with it what it bears.
  for (int attempt = 0; attempt == 0 || (attempt < 4 && !reaches(sample.mesh, solid.features, 2 * spacing));
       ++attempt) {
    if (attempt > 0) spacing *= 0.7;
    sample.mesh = net_of(solid, request.kind, spacing, level, context);
  }
  for (std::size_t round = 0, first_new = 0; round < 4; ++round) {
    const std::size_t before = sample.mesh.positions.size();
    refine(sample.mesh, solid, spacing, wanted, first_new, context);
    first_new = before;
  }
  mark_parts(sample, solid, context);
  return sample;
} catch (const ParameterError& error) {
  throw blaming_what_was_given(request, error);
}

}  // namespace toposcope
