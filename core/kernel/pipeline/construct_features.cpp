// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/construct_features.h"

#include <algorithm>
#include <utility>

#include "pipeline/choose_candidates.h"
#include "pipeline/fit_groups.h"

namespace toposcope {
namespace {

/// Whether two features of a model ask for the same shape of the same types.
bool same_fit(const ModelRun& run, Index f, Index g) {
  const ModelFeature &a = run.model.features[f], &b = run.model.features[g];
  return a.shape.plugin == b.shape.plugin && a.worksets == b.worksets &&
         run.stations.features[f].arguments == run.stations.features[g].arguments;
}

std::vector<FitJob> fit_jobs(const ModelRun& run) {
  std::vector<FitJob> jobs;
  for (Index f = 0; f < run.model.features.size(); ++f) {
    const auto same = std::find_if(jobs.begin(), jobs.end(),
                                   [&](const FitJob& job) { return same_fit(run, job.features.front(), f); });
    if (same != jobs.end())
      same->features.push_back(f);
    else
      jobs.push_back({{f}});
  }
  return jobs;
}

}  // namespace

ConstructedFeatures construct_features(const ModelRun& run, const MeasuredWorkingSets& sets) {
  ConstructedFeatures features;
  features.of_feature.resize(run.model.features.size());
  const std::vector<FitJob> jobs = fit_jobs(run);
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    WorkingSetGroups groups(jobs[j].feature(run.model), jobs[j].types(run.model), sets);
    choose_candidates(jobs[j], fit_groups(jobs[j], std::move(groups), run, sets), run, sets, features);
    run.context.progress(static_cast<double>(j + 1) / static_cast<double>(jobs.size()));
  }
  return features;
}

void construct_more(const ModelRun& run, const MeasuredWorkingSets& sets, Index feature, WorkingSetGroups groups,
                    ConstructedFeatures& features) {
  const FitJob job{{feature}, true};
  choose_candidates(job, fit_groups(job, std::move(groups), run, sets), run, sets, features);
}

}  // namespace toposcope
