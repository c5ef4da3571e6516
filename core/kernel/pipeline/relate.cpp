// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/relate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/errors.h"
#include "pipeline/families.h"
#include "pipeline/places.h"
#include "pipeline/relation_table.h"
#include "probability/likelihood.h"

namespace toposcope {
namespace {

LabelingVariable variable_of(const ModelFeature& feature, const FeatureCandidates& candidates,
                             const ProbabilityModel& probability) {
  LabelingVariable variable;
  variable.name = feature.name;
  variable.detectability = feature.detectability;
  variable.candidates = candidates.constructed;
  DetectabilityCosts costs = detectability_costs(probability, variable.detectability);
  if (feature.count.family()) costs = {0, 0};  // what numbers of instances cost says it
  variable.costs.push_back(costs.missing);
  // A feature that is there is any one of the groups there were to choose from: the prior is shared among them.
  for (std::size_t c = 0; c < candidates.evidence.size(); ++c)
    variable.costs.push_back(costs.present + std::log(candidates.ways[c]) - candidates.evidence[c]);
  return variable;
}

/// No labelling gains by leaving a required feature out, and so being free of its relationships.
void charge_required(const Model& model, LabelingProblem& problem) {
  for (Index v = 0; v < model.features.size(); ++v)
    if (model.features[v].required() && !model.features[v].count.family())
      problem.variables[v].costs[0] += worth(problem, v);
}

/// Whether the variables of one scope have in turn the same candidates as those of the other.
bool same_candidates(const LabelingProblem& problem, const std::vector<Index>& scope, const LabelingProblem& other,
                     const std::vector<Index>& other_scope) {
  return std::equal(scope.begin(), scope.end(), other_scope.begin(), other_scope.end(),
                    [&](Index v, Index w) { return problem.variables[v].candidates == other.variables[w].candidates; });
}

/// Bytes of tables that are there already.
std::uint64_t table_bytes(const LabelingProblem& problem) {
  std::uint64_t bytes = 0;
  for (const LabelingConstraint& constraint : problem.constraints)
    bytes += constraint.costs.size() * (sizeof(double) + sizeof(float));
  return bytes;
}

/// Adds the bytes of a relationship's tables to those that are taken.
void take_memory(const Relationship& relationship, const LabelingProblem& problem, const Context& context,
                 std::uint64_t& taken) {
  taken += table_size(relationship, problem) * (sizeof(double) + sizeof(float));
  if (taken > context.memory_budget())
    throw UsageError(relationship.where.str() + ": with relationship '" + relationship.name +
                     "' the tables of this model would need " + std::to_string(taken) +
                     " bytes, and this run may take " + std::to_string(context.memory_budget()) +
                     "; lower probability.max_candidates");
}

}  // namespace

LabelingProblem relate(const ModelRun& run, const MeasuredWorkingSets& sets, const ConstructedFeatures& features,
                       const LabelingProblem* known) {
  const Model& model = run.model;
  LabelingProblem problem;
  problem.name = model.name;
  for (Index f = 0; f < model.features.size(); ++f)
    problem.variables.push_back(variable_of(model.features[f], features.of_feature[f], run.stations.probability));
  problem.candidate_count = static_cast<Index>(features.all.size());
  problem.conflict_bits = std::move(exclusions(run, sets, features.all).bits);

  std::vector<BoundRelation> relations;
  std::uint64_t taken = known ? table_bytes(*known) : 0;  // bytes in tables, of both while both are there
  for (Index r = 0; r < model.relationships.size(); ++r) {
    const std::vector<Index>& scope = model.relationships[r].features;
    relations.emplace_back(run, r);
    take_memory(model.relationships[r], problem, run.context, taken);
    if (known && same_candidates(problem, scope, *known, scope)) {
      problem.constraints.push_back(known->constraints[r]);
      continue;
    }
    // Port and starboard, wings and stabilisers: one table serves all that ask the same of the same candidates.
    Index twin = 0;
    while (twin < r && !(relations[twin].same_test(relations[r]) &&
                         same_candidates(problem, scope, problem, problem.constraints[twin].scope)))
      ++twin;
    if (twin < r) {
      LabelingConstraint constraint = problem.constraints[twin];
      constraint.name = model.relationships[r].name;
      constraint.scope = scope;
      problem.constraints.push_back(std::move(constraint));
      continue;
    }
    problem.constraints.push_back(relation_table(relations[r], problem, features));
    run.context.progress(static_cast<double>(r + 1) / static_cast<double>(model.relationships.size()));
  }
  charge_required(model, problem);
  return problem;
}

}  // namespace toposcope
