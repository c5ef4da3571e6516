// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/measured_working_sets.h"
#include "pipeline/model_run.h"
#include "pipeline/working_set_groups.h"
#include "toposcope/shapes.h"

namespace toposcope {

/// Features that ask for the same shape of the same types share their fits.
struct FitJob {
  std::vector<Index> features;  ///< of the model, at least one
  bool second_look = false;     ///< of the types that the features name for it
  std::size_t shape = 0;        ///< which of the first feature's shapes it is

  const ShapeStation& station(const Stations& stations) const {
    return stations.features[features.front()].shape(shape);
  }
  const ModelFeature& feature(const Model& model) const { return model.features[features.front()]; }
  const std::vector<std::string>& types(const Model& model) const {
    return second_look ? feature(model).second_look : feature(model).worksets;
  }
};

/// How far a group comes with one feature.
enum class GroupStatus : std::uint8_t {
  boxed_out,     ///< could not meet the ranges, by its boxes: not fitted for this feature
  unusable,      ///< the fit failed or is degenerate
  out_of_range,  ///< a measure outside the model's range
  poor_fit,      ///< fit error beyond max_fit_error
  fitted
};

/// What became of a group with one feature, and of the bound that it broke: BoundCount::bound, its value, the limit.
struct GroupVerdict {
  GroupStatus status = GroupStatus::boxed_out;
  Index bound = 0;
  double value = 0, limit = 0;
};

/// The fits of one job, one per group.
struct GroupFits {
  WorkingSetGroups groups;
  std::vector<FittedShape> shapes = {};
  std::vector<Box> boxes = {};                           ///< bb(w)
  std::vector<std::vector<GroupVerdict>> verdicts = {};  ///< per feature of the job, per group
};

/// Fits, in parallel, the groups that may meet the ranges of some feature of the job.
/// \throw PluginError  the fitter threw
GroupFits fit_groups(const FitJob& job, WorkingSetGroups groups, const ModelRun& run, const MeasuredWorkingSets& sets);

}  // namespace toposcope
