// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/dataset_mesh.h"

#include <algorithm>

#include "io/mesh_io.h"
#include "pipeline/filters.h"
#include "sample/sample.h"
#include "sample/scan.h"

namespace toposcope {
namespace {

constexpr Index fine_faces = 20000;

Truth truth_of(const Sample& sample) {
  Truth truth;
  truth.class_name = sample.kind;
  for (const SampleFeature& made : sample.features) {
    TruthFeature& feature = truth.features.emplace_back();
    feature.name = made.name;
    if (made.groups.empty()) feature.points = made.points;
    for (const MarkGroup& ring : made.groups) {
      TruthGroup& group = feature.groups.emplace_back();
      group.name = ring.name;
      group.centroid = ring.centroid;
      for (const Index i : ring.members) group.points.push_back(made.points[i]);
    }
    const auto values = [&](std::string_view name) -> const std::vector<double>* {
      for (const auto& [each, list] : made.parameters)
        if (each == name) return &list;
      return nullptr;
    };
    if (const std::vector<double>* band = values("band")) {
      const std::vector<double>&center = *values("center"), &normal = *values("normal");
      feature.band = {Vec3(center.data()), Vec3(normal.data()), band->at(0), band->at(1)};
    }
  }
  return truth;
}

Sample scanned(const SampleRequest& request, const DatasetMesh& item, PluginHost& host, Context& context) {
  ScanSettings settings;
  settings.faces = item.faces;
  settings.seen_from = item.view;
  settings.seed = item.seed;
  settings.parts = false;  // features are judged, not parts
  if (item.noise) settings.noise_rel = *item.noise;
  return scan(make_scan_target(request, context), settings, host, context);
}

/// Of more faces than the object's own fine mesh is asked for, those that the quadric error keeps: long and thin along
/// pipes, large on flats.
Mesh decimated(Mesh mesh, const DatasetMesh& item, PluginHost& host, Context& context) {
  const GivenOption given[] = {{"faces", std::to_string(item.faces)}};
  const FilterStation filter = make_filter(host, "decimate", given, item.name);
  PreparedMesh prepared = apply_filters(mesh, {&filter, 1}, context);
  return prepared.filtered ? std::move(*prepared.filtered) : std::move(mesh);
}

KnownMesh made(const DatasetMesh& item, PluginHost& host, Context& context) {
  SampleRequest request;
  request.kind = item.kind;
  request.parameters = item.parameters;
  request.preset = item.preset;
  request.random = item.random;
  request.faces = item.decimated ? std::max(fine_faces, item.faces) : item.faces;
  request.seed = item.seed;
  if (!item.scan) request.noise_rel = item.noise.value_or(0);
  Sample sample = item.scan ? scanned(request, item, host, context) : make_sample(request, context);
  Truth truth = truth_of(sample);
  Mesh mesh = repaired_mesh(std::move(sample.mesh), item.name, &context).mesh;
  if (item.decimated) mesh = decimated(std::move(mesh), item, host, context);
  return {std::move(mesh), std::move(truth)};
}

}  // namespace

KnownMesh load(const DatasetMesh& item, PluginHost& host, Context& context) {
  if (item.file.empty()) return made(item, host, context);
  KnownMesh known{read_repaired_mesh(item.file, &context).mesh, {}};
  if (!item.truth.empty()) known.truth = read_truth(item.truth);
  return known;
}

}  // namespace toposcope
