// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/analysis.h"
#include "result/result.h"

namespace toposcope {

/// A candidate of a feature, seen beside the labelling that is reported.
struct ProbedCandidate {
  Index rank = 0;  ///< from 1, as in result.json
  bool labelled = false;
  bool in_conflict = false;  ///< shares its place with another labelled feature
  double probability = 0;    ///< its posterior; not a number where there is none
  double evidence = 0;       ///< of its fit, nats
  double cost = 0;           ///< that labelling it would add over leaving the feature missing, all else as it is, nats
  FittedShape shape;
  std::vector<RelationReport> relations;  ///< that name the feature, all others as they are labelled
};

/// Bounds that keep the nearest group out, in the order in which they would have to give way.
struct NeededChange {
  std::string bound;   ///< as the model has it
  double value = 0;    ///< of the nearest group
  double limit = 0;    ///< what the bound is
  std::string remedy;  ///< the bound that would do, over the side of bb(O) that it is measured by
};

/// All that a model's feature met on a mesh.
struct FeatureProbe {
  std::string name, types, shape;
  CandidateCount count;
  std::vector<ProbedCandidate> candidates;  ///< best evidence first
  std::vector<NeededChange> changes;        ///< that would let the nearest candidate in; one where one is enough
  bool enough = false;                      ///< with these changes there is one
};

/// \param analysis  of `analyze`
/// \param most      candidates at most
FeatureProbe probe(const Analysis& analysis, const Model& model, const Stations& stations, Index feature,
                   std::size_t most, Context& context);

/// As `model probe` prints it.
std::string to_text(const FeatureProbe& probe);
/// {mesh, model, features: {name: {...}}}, on one line.
std::string to_json(const std::vector<FeatureProbe>& probes, const std::string& mesh, const std::string& model);

}  // namespace toposcope
