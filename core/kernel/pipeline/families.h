// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/classes.h"
#include "pipeline/constructed_features.h"
#include "pipeline/model_run.h"
#include "pipeline/solve.h"
#include "toposcope/labeling/families.h"

namespace toposcope {

bool has_families(const Model& model);

/// What a feature would be worth to an object that is as the model says, in nats: its best fit on this mesh, and each
/// of its relationships at its best, as likely as the others in it are found. A labelling without a required feature
/// pays it.
double worth(const LabelingProblem& problem, Index variable);

/// The families of a model, with what each number of instances costs.
/// \param any_number  as if the model did not say how many there may be
std::vector<Family> families_of(const LabelingProblem& problem, const ModelRun& run, bool any_number);

/// Solves a model with families for its labellings and sums: fills what `solved` has of them.
/// \throw PluginError
SolveTimes solve_with_families(ClassOutcome& solved, const ModelRun& run, const LabelingRequest& request);

/// The labelling of least cost, of the features that are no families.
std::vector<Index> best_with_families(const LabelingProblem& problem, const ModelRun& run);

/// A model whose families are written out: the instances that were found, and as many more as there must be.
struct Instances {
  Model model;
  Stations stations;
  std::vector<Index> origin;  ///< per feature the one of the model
};

/// Writes the instances out as features of their own: in the problem and what was found, and in the model.
/// \param solved  is replaced
Instances write_out_instances(ClassOutcome& solved, const ConstructedFeatures& features, const ModelRun& run);

}  // namespace toposcope
