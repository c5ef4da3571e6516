// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/model.h"
#include "pipeline/stations.h"
#include "pipeline/working_set_groups.h"
#include "pipeline/working_sets.h"
#include "toposcope/shapes.h"

namespace toposcope {

/// A shape fitted to a group of working sets: C(f) = (W, G(W), E(W)) of dissertation 3.4.1. Made once and shared by
/// all model features that ask for the same shape of the same types.
struct ConstructedFeature {
  std::vector<Index> sets;  ///< working sets, in the order of the feature's types
  FittedShape shape;
  Box box;                      ///< bb(w)
  std::vector<Vec3> points;     ///< of all sets, one after the other
  std::vector<Index> vertices;  ///< of the mesh, one per point
};

/// How many groups of working sets a feature lost at each condition.
struct CandidateCount {
  std::size_t groups = 0;        ///< groups of working sets of the right types
  std::size_t boxed_out = 0;     ///< could not meet the ranges, by their boxes
  std::size_t unusable = 0;      ///< the fit failed or is degenerate
  std::size_t out_of_range = 0;  ///< a parameter outside the model's range
  std::size_t poor_fit = 0;      ///< fit error beyond max_fit_error
  std::size_t beaten = 0;        ///< the same as a better one, or beyond the number of candidates kept
  std::size_t kept = 0;
};

/// T(f) for one model feature, best evidence first once each has paid for the choice among its look's groups.
struct FeatureCandidates {
  std::vector<Index> constructed;  ///< into ConstructedFeatures::all
  std::vector<double> evidence;    ///< log likelihood ratio of each
  std::vector<double> ways;        ///< of each: how many candidates the look that found it had to choose from
  CandidateCount count;
};

struct ConstructedFeatures {
  std::vector<Box> set_boxes;  ///< of the working sets
  VertexMeasures of_vertices;
  std::vector<ConstructedFeature> all;
  std::vector<FeatureCandidates> of_feature;  ///< one per model feature
};

/// Fits every shape that the model asks for to every group of working sets that may meet its ranges, in parallel, and
/// keeps for each feature the candidates of greatest evidence.
ConstructedFeatures construct_features(const MeshView& mesh, const Model& model, const WorkingSets& sets,
                                       const BitMatrix& overlap, const Stations& stations, Context& context);

/// Fits a feature's shape to more groups, of the types of its second look; the best of old and new candidates stay.
/// Of those that lie in the same places with the same shape one stays and stands for them all.
/// \param chosen_from  how many groups these were chosen from
void construct_more(const MeshView& mesh, const Model& model, const WorkingSets& sets, Index feature,
                    const WorkingSetGroups& groups, std::size_t chosen_from, const BitMatrix& overlap,
                    const Stations& stations, Context& context, ConstructedFeatures& features);

}  // namespace toposcope
