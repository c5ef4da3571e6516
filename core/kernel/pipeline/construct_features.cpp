// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/construct_features.h"

#include <algorithm>
#include <utility>

#include "pipeline/choose_candidates.h"
#include "pipeline/fit_groups.h"

namespace toposcope {
namespace {

/// Features that ask for the same shape of the same types share a job.
std::vector<FitJob> fit_jobs(const ModelRun& run) {
  std::vector<FitJob> jobs;
  for (Index f = 0; f < run.model.features.size(); ++f)
    for (std::size_t k = 0; k < run.stations.features[f].shape_count(); ++k) {
      const ShapeStation& wanted = run.stations.features[f].shape(k);
      const auto same = std::find_if(jobs.begin(), jobs.end(), [&](const FitJob& job) {
        const ShapeStation& station = job.station(run.stations);
        return station.plugin == wanted.plugin && station.arguments == wanted.arguments &&
               job.feature(run.model).worksets == run.model.features[f].worksets;
      });
      if (same != jobs.end())
        same->features.push_back(f);
      else
        jobs.push_back({{f}, false, k});
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
  for (std::size_t k = 0; k < run.stations.features[feature].shape_count(); ++k) {
    const FitJob job{{feature}, true, k};
    choose_candidates(job, fit_groups(job, groups, run, sets), run, sets, features);
  }
}

}  // namespace toposcope
