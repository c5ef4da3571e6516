// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "base/errors.h"
#include "sample/isosurface.h"
#include "sample/scan.h"
#include "sample/solid.h"

namespace toposcope {

namespace {

/// Cuts each triangle into four; the edges' middles move onto the surface.
void subdivide(TriangleSoup& mesh, const Implicit& surface, double spacing, Context& context) {
  struct Edge {
    Index from, to, half_edge;
    bool operator<(const Edge& other) const {
      return from != other.from ? from < other.from : to != other.to ? to < other.to : half_edge < other.half_edge;
    }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (Index f = 0; f < mesh.triangles.size(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[f][k], b = mesh.triangles[f][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), 3 * f + k});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<Index> middle(edges.size());
  const std::size_t old = mesh.positions.size();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i == 0 || edges[i].from != edges[i - 1].from || edges[i].to != edges[i - 1].to)
      mesh.positions.push_back((mesh.positions[edges[i].from] + mesh.positions[edges[i].to]) / 2);
    middle[edges[i].half_edge] = static_cast<Index>(mesh.positions.size() - 1);
  }
  context.parallel_for(mesh.positions.size() - old, 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = old + first; v < old + last; ++v)
      mesh.positions[v] = project(surface, mesh.positions[v], spacing);
  });
  std::vector<Triangle> triangles;
  triangles.reserve(4 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    const Index ab = middle[3 * f], bc = middle[3 * f + 1], ca = middle[3 * f + 2];
    triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(triangles);
}

}  // namespace

Sample make_scan_target(const SampleRequest& request, Context& context) {
  Sample sample;
  sample.kind = request.kind;
  sample.seed = request.seed;
  sample.parameters = requested_parameters(request);
  const Solid solid = make_solid(request.kind, sample.parameters);
  const double level = net_level(solid), spacing = 0.55 * (solid.thinnest + 2 * level);  // as make_sample
  try {
    sample.mesh = extract_isosurface(solid.surface, solid.low, solid.high, spacing, level, context);
  } catch (const std::length_error&) {
    throw UsageError(fmt::format("{}: {} is {}: too thin for the object's size to be meshed; give more", request.kind,
                                 solid.thinnest_parameter, solid.thinnest));
  }
  subdivide(sample.mesh, solid.surface, spacing, context);
  sample.thinnest = solid.thinnest;
  sample.features = solid.features;
  sample.part_names = solid.part_names;
  sample.face_part.resize(sample.mesh.triangles.size());
  context.parallel_for(sample.face_part.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const Triangle& t = sample.mesh.triangles[f];
      const auto& p = sample.mesh.positions;
      sample.face_part[f] = static_cast<std::uint8_t>(solid.part_of((p[t[0]] + p[t[1]] + p[t[2]]) / 3));
    }
  });
  return sample;
}

}  // namespace toposcope
