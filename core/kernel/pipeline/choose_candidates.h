// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "pipeline/constructed_features.h"
#include "pipeline/fit_groups.h"

namespace toposcope {

/// How candidates are chosen: at the first look at the mesh, or at one that a first labelling guides.
struct Choosing {
  /// Of a second look, how many groups its groups were chosen from: of those that were not tried as many would have
  /// passed as of those that were. Groups in the same places with the same shape are one candidate then.
  std::optional<std::size_t> chosen_from;
  const BitMatrix& overlap;  ///< of the working sets
  const ProbabilityModel& probability;
};

/// Adds the fitted groups to the candidates that each feature of the job has; those of greatest evidence stay.
void choose_candidates(const FitJob& job, const WorkingSetGroups& groups, const GroupFits& fits,
                       const FitGround& ground, const Choosing& choosing, ConstructedFeatures& out);

}  // namespace toposcope
