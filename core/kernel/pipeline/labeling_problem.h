// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/analysis.h"

namespace toposcope {

/// Tests a relationship of the model between constructed features, given in its order.
RelationResult test_relationship(const MeshView& mesh, const Model& model, Index relationship,
                                 std::span<const ConstructedFeature* const> features, const Stations& stations,
                                 Context& context);

/// The station *relate*: the labelling problem of a mesh. Variable i is model feature i, constraint i relationship i.
/// \param known  of the same mesh and model, with fewer candidates: where those of a relationship's features are the
/// same,
///               so is its table
/// \throw UsageError  a relationship's table would be too large
LabelingProblem build_problem(const MeshView& mesh, const Model& model, const ConstructedFeatures& features,
                              const BitMatrix& overlap, const Stations& stations, Context& context,
                              const LabelingProblem* known = nullptr);

/// The questions that a model puts: one per class rule, with only the features that its relationships name and these
/// relationships as constraints; the whole problem when the model has no classes. A feature that a class
/// names belongs to it, so that its detectability there is `certainty`.
std::vector<ClassOutcome> pose_classes(const LabelingProblem& problem, const Model& model,
                                       const ProbabilityModel& probability);

/// The problem with only the given values of each variable (ascending; 0, *missing*, among them).
LabelingProblem restricted(const LabelingProblem& problem, const std::vector<std::vector<Index>>& kept);

/// Refuses an outcome that breaks the labelers' contract: no labelling, values out of range, two features that share a
/// vertex, a bound above a labelling's cost, posteriors of the wrong size or that do not sum to 1. \throw PluginError
void check_outcome(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& plugin);

}  // namespace toposcope
