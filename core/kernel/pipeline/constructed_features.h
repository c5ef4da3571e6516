// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "toposcope/shapes.h"

namespace toposcope {

/// A shape fitted to a group of working sets: C(f) = (W, G(W), E(W)) of dissertation 3.4.1. Made once and shared by
/// all model features that ask for the same shape of the same types.
struct ConstructedFeature {
  std::vector<Index> sets;  ///< working sets, in the order of the feature's types
  FittedShape shape;
  const ShapeFitter* fitter = nullptr;  ///< that made the shape
  std::string plugin;                   ///< its id
  int dimension = -1;                   ///< of its shapes, as the plugin says; -1: unknown
  Box box;                              ///< bb(w)
  std::vector<Vec3> points;             ///< of all sets, one after the other
  std::vector<Index> vertices;          ///< of the mesh, one per point
};

/// What one bound of the model cost a feature.
struct BoundCount {
  Index bound = 0;         ///< 2 r + 0 the lower and + 1 the upper one of range r; after them max_fit_error
  std::string words;       ///< "radius < bb(O).a/2"
  std::size_t groups = 0;  ///< that broke it, and no bound before it
  double nearest = 0;      ///< of these the value that misses it least, as boxes or the fit tell, in its unit
  double limit = 0;        ///< what the bound is of that group
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
  std::vector<BoundCount> bounds;  ///< that cost something, in the order of the model
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
