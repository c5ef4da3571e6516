// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

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
  std::size_t out_of_range = 0;  ///< a measure outside the model's range
  std::size_t poor_fit = 0;      ///< fit error beyond max_fit_error
  std::size_t beaten = 0;        ///< the same as a better one, or beyond the number of candidates kept
  std::size_t kept = 0;
};

/// T(f) for one model feature, best evidence first once each has paid for the choice among its look's groups.
struct FeatureCandidates {
  std::vector<Index> constructed;  ///< into ConstructedFeatures::all
  std::vector<double> evidence;    ///< log likelihood ratio of each, in nats
  std::vector<double> ways;        ///< of each: how many candidates the look that found it had to choose from
  CandidateCount count;
};

struct ConstructedFeatures {
  std::vector<ConstructedFeature> all;
  std::vector<FeatureCandidates> of_feature;  ///< one per model feature
};

}  // namespace toposcope
