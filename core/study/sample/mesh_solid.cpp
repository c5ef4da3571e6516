// SPDX-License-Identifier: BSD-3-Clause
#include "sample/mesh_solid.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/errors.h"
#include "sample/isosurface.h"
#include "sample/parameters.h"
#include "sample/remesh.h"

namespace toposcope {

namespace {

/// Faces that look inwards: where a net was drawn onto a surface that is too far from it, or too bent.
bool is_folded(const TriangleSoup& mesh, const Implicit& surface, Context& context) {
  std::vector<Vec3> normals(mesh.positions.size());
  context.parallel_for(normals.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) normals[v] = surface(mesh.positions[v]).gradient;
  });
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const Vec3 &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
    return (q - p).cross(r - p).dot(normals[t[0]] + normals[t[1]] + normals[t[2]]) < 0;
  });
}

/// A net that resolves the solid's thinnest part and has more faces than asked for. Thin material comes out whole on a
/// coarser grid when the net is laid a little outside it; but gaps become narrower there, and hollows may fold.
TriangleSoup fine_net(const Solid& solid, const SampleRequest& request, Context& context) {
  // Of the thickness at the level: below 1 / sqrt(3) no cell meets both sides of a wall.
  constexpr double cell = 0.55;
  double level = net_level(solid);
  double spacing = cell * (solid.thinnest + 2 * level);
  for (int attempt = 0; attempt < 10; ++attempt) {
    TriangleSoup fine = net_of(solid, request.kind, spacing, level, context);
    const double found = static_cast<double>(fine.triangles.size()), wanted = request.faces;
    if (found < 1.2 * wanted) {
      spacing *= std::sqrt(found / (1.35 * wanted));
      level = std::clamp((spacing / cell - solid.thinnest) / 2, 0.0, level);
    } else if (!is_closed_manifold(fine)) {
      spacing *= 0.87;  // two sheets meet in one cell
    } else if (level > 0 && is_folded(fine, solid.surface, context)) {
      level = level > 0.1 * solid.thinnest ? 0.5 * level : 0;
      spacing = std::min(spacing, cell * (solid.thinnest + 2 * level));
    } else {
      return fine;
    }
  }
  return {};
}

}  // namespace

TriangleSoup net_of(const Solid& solid, const std::string& kind, double spacing, double level, Context& context) {
  try {
    return extract_isosurface(solid.surface, solid.low, solid.high, spacing, level, context);
  } catch (const std::length_error&) {
    throw ParameterError(kind, solid.thinnest_parameter,
                         fmt::format("{} is {}: too thin for the object's size to be meshed; give more",
                                     solid.thinnest_parameter, solid.thinnest));
  }
}

TriangleSoup mesh_solid(const Solid& solid, const SampleRequest& request, Context& context) {
  const double faces = request.faces;
  const TriangleSoup fine = fine_net(solid, request, context);
  if (fine.triangles.empty())
    throw ParameterError(
        request.kind, solid.thinnest_parameter,
        fmt::format("{} is {}: no grid resolves the object; give more", solid.thinnest_parameter, solid.thinnest));
  TriangleSoup mesh = remesh(fine, solid.surface, request.faces, context);
  if (static_cast<double>(mesh.triangles.size()) > 1.03 * faces)
    throw UsageError(fmt::format("{}: faces is {}: the object's curved parts need at least {} faces; ask for more",
                                 request.kind, request.faces, mesh.triangles.size()));
  return mesh;
}

void mark_parts(Sample& sample, const Solid& solid, Context& context) {
  sample.part_names = solid.part_names;
  sample.face_part.resize(sample.mesh.triangles.size());
  context.parallel_for(sample.face_part.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const Triangle& t = sample.mesh.triangles[f];
      const auto& p = sample.mesh.positions;
      sample.face_part[f] = static_cast<std::uint8_t>(solid.part_of((p[t[0]] + p[t[1]] + p[t[2]]) / 3));
    }
  });
}

}  // namespace toposcope
