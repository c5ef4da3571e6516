// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/classes.h"
#include "pipeline/constructed_features.h"
#include "pipeline/model_run.h"

namespace toposcope {

/// A class that was solved, and which of its features could change names.
struct Interchange {
  const ClassOutcome& solved;
  const std::vector<std::vector<Index>>& orbits;  ///< `orbits_of` the question's renamings
  const ConstructedFeatures& features;
  const ModelRun& run;
};

/// A value for each variable by which interchangeable features are told apart: that of the labelling of least cost, and
/// for features that it leaves out, where there are posteriors, the places that are more likely than not taken by some
/// feature of the orbit, the most likely one first (the probability of a place is summed over the features that could
/// change names, and over the candidates of one shape). 0 where there is no such place.
std::vector<Index> own_places(const Interchange& interchange);

/// Values of each variable that stay once names are given by place: those nearer to the variable's own place than to
/// that of any feature with which it could change names; for a feature without a place those that are no other's. So an
/// airplane's port wing has one side, and four equal holes one feature each, and not a part of the probability of all.
/// \param places  as `own_places` makes them
/// \param places  as `own_places` makes them
std::vector<std::vector<Index>> told_apart(const Interchange& interchange, const std::vector<Index>& places);

/// Posteriors of the values that stay, summed over all ways to give names: that a feature has its own place is that any
/// of those with which it could change names has it. What is left of 1 goes to its other values and *missing*. \pre
/// there are posteriors; `kept` as `told_apart` makes it
std::vector<std::vector<double>> summed_over_names(const Interchange& interchange, const std::vector<Index>& places,
                                                   const std::vector<std::vector<Index>>& kept);

}  // namespace toposcope
