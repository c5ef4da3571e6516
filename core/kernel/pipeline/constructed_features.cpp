// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/constructed_features.h"

#include <algorithm>

#include "pipeline/choose_candidates.h"
#include "pipeline/fit_groups.h"
#include "pipeline/working_set_groups.h"
#include "plugin/plugin_host.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

constexpr std::size_t grain = 8;

std::vector<FitJob> fit_jobs(const Model& model, const Stations& stations) {
  std::vector<FitJob> jobs;
  for (Index f = 0; f < model.features.size(); ++f) {
    const ModelFeature& feature = model.features[f];
    const auto same = std::find_if(jobs.begin(), jobs.end(), [&](const FitJob& job) {
      return job.feature->shape.plugin == feature.shape.plugin && job.feature->worksets == feature.worksets &&
             *job.arguments == stations.shape_arguments[f];
    });
    if (same != jobs.end())
      same->features.push_back(f);
    else
      jobs.push_back({&feature,
                      &feature.worksets,
                      &stations.shape_arguments[f],
                      stations.shapes.at(feature.shape.plugin).get(),
                      {f}});
  }
  return jobs;
}

/// Of the sets that a feature of the model asks for.
std::vector<Box> boxes_of(const WorkingSets& sets, const Model& model, const MeshView& mesh, Context& context) {
  std::vector<char> asked(sets.type_names.size(), 0);
  for (const ModelFeature& feature : model.features)
    for (const std::vector<std::string>* types : {&feature.worksets, &feature.second_look})
      for (std::size_t t = 0; t < asked.size(); ++t)
        if (std::find(types->begin(), types->end(), sets.type_names[t]) != types->end()) asked[t] = 1;
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

void construct(const FitJob& job, const WorkingSetGroups& groups, const MeshView& mesh, const Model& model,
               const WorkingSets& sets, const Choosing& choosing, Context& context, ConstructedFeatures& features) {
  const FitGround ground{mesh, model, sets, features.set_boxes, features.of_vertices};
  const GroupFits fits = guard(job.feature->shape.plugin, [&] { return fit_groups(job, groups, ground, context); });
  choose_candidates(job, groups, fits, ground, choosing, features);
}

}  // namespace

ConstructedFeatures construct_features(const MeshView& mesh, const Model& model, const WorkingSets& sets,
                                       const BitMatrix& overlap, const Stations& stations, Context& context) {
  ConstructedFeatures features;
  features.set_boxes = boxes_of(sets, model, mesh, context);
  features.of_vertices = VertexMeasures(mesh);
  features.of_feature.resize(model.features.size());
  const std::vector<FitJob> jobs = fit_jobs(model, stations);
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const WorkingSetGroups groups(*jobs[j].feature, *jobs[j].types, sets, overlap);
    construct(jobs[j], groups, mesh, model, sets, {{}, overlap, stations.probability}, context, features);
    context.progress(static_cast<double>(j + 1) / static_cast<double>(jobs.size()));
  }
  return features;
}

void construct_more(const MeshView& mesh, const Model& model, const WorkingSets& sets, Index feature,
                    const WorkingSetGroups& groups, std::size_t chosen_from, const BitMatrix& overlap,
                    const Stations& stations, Context& context, ConstructedFeatures& features) {
  const ModelFeature& asking = model.features[feature];
  const FitJob job{&asking,
                   &asking.second_look,
                   &stations.shape_arguments[feature],
                   stations.shapes.at(asking.shape.plugin).get(),
                   {feature}};
  construct(job, groups, mesh, model, sets, {chosen_from, overlap, stations.probability}, context, features);
}

}  // namespace toposcope
