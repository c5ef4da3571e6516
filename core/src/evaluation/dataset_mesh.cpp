// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/dataset_mesh.h"

#include "io/mesh_io.h"
#include "sample/sample.h"

namespace toposcope {
namespace {

Truth truth_of(const Sample& sample) {
  Truth truth;
  truth.class_name = sample.kind;
  for (const SampleFeature& made : sample.features) {
    TruthFeature& feature = truth.features.emplace_back();
    feature.name = made.name;
    if (made.groups.empty()) feature.points = made.points;
    for (const auto& [name, members] : made.groups) {
      TruthGroup& group = feature.groups.emplace_back();
      group.name = name;
      for (const Index i : members) {
        group.points.push_back(made.points[i]);
        group.centroid += made.points[i] / static_cast<double>(members.size());
      }
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

KnownMesh made(const DatasetMesh& item, Context& context) {
  SampleRequest request;
  request.kind = item.kind;
  request.parameters = item.parameters;
  request.faces = item.faces;
  request.noise_rel = item.noise.value_or(0);
  request.seed = item.seed;
  Sample sample = make_sample(request, context);
  Truth truth = truth_of(sample);
  return {repaired_mesh(std::move(sample.mesh), item.name, &context).mesh, std::move(truth)};
}

}  // namespace

KnownMesh load(const DatasetMesh& item, PluginHost&, Context& context) {
  if (item.file.empty()) return made(item, context);
  KnownMesh known{read_repaired_mesh(item.file, &context).mesh, {}};
  if (!item.truth.empty()) known.truth = read_truth(item.truth);
  return known;
}

}  // namespace toposcope
