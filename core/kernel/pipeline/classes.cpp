// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/classes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "probability/symmetry.h"

namespace toposcope {
namespace {

bool names(const ClassRule& rule, const LabelingProblem& problem, Index variable) {
  return std::any_of(rule.relationships.begin(), rule.relationships.end(), [&](Index r) {
    const auto& scope = problem.constraints[r].scope;
    return std::find(scope.begin(), scope.end(), variable) != scope.end();
  });
}

ClassOutcome whole_model(const LabelingProblem& problem, const Model& model) {
  ClassOutcome whole;
  whole.name = model.name;
  whole.problem = problem;
  whole.features.resize(problem.variables.size());
  whole.relationships.resize(problem.constraints.size());
  std::iota(whole.features.begin(), whole.features.end(), 0);
  std::iota(whole.relationships.begin(), whole.relationships.end(), 0);
  return whole;
}

ClassOutcome part_of(const LabelingProblem& problem, const ClassRule& rule, const ProbabilityModel& probability) {
  ClassOutcome part;
  part.name = part.problem.name = rule.name;
  part.relationships = rule.relationships;
  part.problem.candidate_count = problem.candidate_count;
  part.problem.conflict_bits = problem.conflict_bits;
  for (Index v = 0; v < problem.variables.size(); ++v) {
    if (!names(rule, problem, v)) continue;
    part.features.push_back(v);
    LabelingVariable& variable = part.problem.variables.emplace_back(problem.variables[v]);
    const DetectabilityCosts general = detectability_costs(probability, variable.detectability);
    const DetectabilityCosts here = detectability_costs(probability, 1);
    variable.detectability = 1;
    variable.costs[0] += here.missing - general.missing;
    for (std::size_t k = 1; k < variable.costs.size(); ++k) variable.costs[k] += here.present - general.present;
  }
  for (Index r : rule.relationships) {
    LabelingConstraint& constraint = part.problem.constraints.emplace_back(problem.constraints[r]);
    for (Index& v : constraint.scope)
      v = static_cast<Index>(std::find(part.features.begin(), part.features.end(), v) - part.features.begin());
  }
  return part;
}

}  // namespace

std::vector<ClassOutcome> pose_classes(const LabelingProblem& problem, const Model& model,
                                       const ProbabilityModel& probability) {
  if (model.classes.empty()) return {whole_model(problem, model)};
  std::vector<ClassOutcome> posed;
  for (const ClassRule& rule : model.classes) posed.push_back(part_of(problem, rule, probability));
  return posed;
}

std::vector<std::vector<Index>> renamings_of(const ClassOutcome& posed, const Model& model, const Stations& stations) {
  std::vector<bool> ordered;
  for (const RelationshipStation& relationship : stations.relationships) ordered.push_back(relationship.ordered);
  return renamings({model, posed.features, posed.relationships, ordered, model.classes.empty()});
}

std::vector<double> comparable_evidence(const std::vector<Explained>& classes) {
  const bool summed =
      std::none_of(classes.begin(), classes.end(), [](const Explained& c) { return std::isnan(c.log_evidence); });
  std::vector<double> evidence;
  for (const Explained& c : classes) evidence.push_back(summed ? c.log_evidence : -c.least_cost);
  return evidence;
}

std::vector<double> class_probabilities(std::vector<double> log_evidence) {
  log_evidence.push_back(0);  // everything is clutter
  const double top = *std::max_element(log_evidence.begin(), log_evidence.end());
  double sum = 0;
  for (double& e : log_evidence) sum += e = std::exp(e - top);
  for (double& e : log_evidence) e /= sum;
  return log_evidence;
}

}  // namespace toposcope
