// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/dataset_mesh.h"

#include "io/mesh_io.h"
#include "pipeline/filters.h"

namespace toposcope {
namespace {

/// Keeps what the quadric error keeps: faces long and thin along pipes, large on flats.
Mesh decimated(Mesh mesh, Index faces, const std::string& name, PluginHost& host, Context& context) {
  const GivenOption given[] = {{"faces", std::to_string(faces)}};
  const FilterStation filter = make_filter(host, "decimate", given, name);
  PreparedMesh prepared = apply_filters(mesh, {&filter, 1}, context);
  return prepared.filtered ? std::move(*prepared.filtered) : std::move(mesh);
}

KnownMesh make(const MadeMesh& source, const std::string& name, PluginHost& host, Context& context) {
  Sample sample = source.scan ? scan(make_scan_target(source.object, context), *source.scan, host, context)
                              : make_sample(source.object, context);
  auto [mesh, repair] = repaired_mesh(std::move(sample.mesh), name, &context);
  if (source.decimate_to > 0) mesh = decimated(std::move(mesh), source.decimate_to, name, host, context);
  return {std::move(mesh), repair, std::move(sample.truth)};
}

}  // namespace

KnownMesh load(const DatasetMesh& item, PluginHost& host, Context& context) {
  if (const auto* source = std::get_if<MadeMesh>(&item.source)) return make(*source, item.name, host, context);
  const auto& file = std::get<MeshFile>(item.source);
  auto [mesh, repair] = read_repaired_mesh(file.path, &context);
  KnownMesh known{std::move(mesh), repair};
  if (!file.truth.empty()) known.truth = read_truth(file.truth);
  return known;
}

}  // namespace toposcope
