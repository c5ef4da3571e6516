// SPDX-License-Identifier: BSD-3-Clause
#include "sample/sample.h"

#include <fmt/format.h>

#include <array>
#include <random>
#include <utility>

#include "base/errors.h"
#include "sample/mesh_solid.h"
#include "toposcope/system/random.h"

namespace toposcope {

namespace {

void number_faces(TriangleSoup& mesh) {
  mesh.input_faces = static_cast<Index>(mesh.triangles.size());
  for (Index f = 0; f < mesh.input_faces; ++f) mesh.face_origin.push_back(f);
}

void add_noise(std::vector<Vec3>& positions, const Implicit& surface, const SampleRequest& request) {
  Vec3 low = positions.front(), high = low;
  for (const Vec3& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double sd = request.noise_rel * (high - low).norm();
  std::mt19937_64 random(request.seed);
  for (std::size_t i = 0; i < positions.size(); i += 2) {
    const double u = uniform_open(random());
    const std::array<double, 2> pair = normal_pair(u, uniform_open(random()));
    for (std::size_t k = 0; k < 2 && i + k < positions.size(); ++k)
      positions[i + k] += sd * pair[k] * surface(positions[i + k]).gradient.normalized();
  }
}

/// The tessellation's own faces, however many.
Sample tessellated(const Solid& solid, const SampleRequest& request, Sample sample) {
  if (request.noise_rel > 0)
    throw UsageError(
        fmt::format("{}: noise is {}: a tessellation is exact; scan it instead", request.kind, request.noise_rel));
  TessellatedSolid made = solid.tessellate(false);
  sample.mesh = std::move(made.mesh);
  sample.face_part = std::move(made.face_part);
  sample.part_names = solid.part_names;
  sample.tessellated = true;
  number_faces(sample.mesh);
  sample.truth.features = solid.features;
  for (TruthFeature& feature : sample.truth.features) mark_vertices(feature, sample.mesh.positions);
  return sample;
}

}  // namespace

Sample make_sample(const SampleRequest& request, Context& context) try {
  Sample sample;
  sample.truth.class_name = request.kind;
  sample.parameters = requested_parameters(request);
  sample.noise_rel = request.noise_rel;
  sample.seed = request.seed;

  const Solid solid = make_solid(request.kind, sample.parameters);
  if (solid.tessellate) return tessellated(solid, request, std::move(sample));
  sample.mesh = mesh_solid(solid, request, context);
  const auto& triangles = sample.mesh.triangles;
  std::vector<Vec3>& positions = sample.mesh.positions;
  number_faces(sample.mesh);

  sample.truth.features = solid.features;
  for (TruthFeature& feature : sample.truth.features) mark_vertices(feature, positions);
  mark_parts(sample, solid, context);
  if (request.noise_rel > 0) add_noise(positions, solid.surface, request);
  context.log(LogLevel::debug,
              fmt::format("{}: {} vertices, {} faces", request.kind, positions.size(), triangles.size()));
  return sample;
} catch (const ParameterError& error) {
  throw blaming_what_was_given(request, error);
}

}  // namespace toposcope
