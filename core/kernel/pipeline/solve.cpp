// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/solve.h"

#include <cmath>
#include <utility>

#include "plugin/guard.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr double posterior_rounding = 1e-6;  ///< of a variable's probabilities, summed

void check_labelings(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& plugin) {
  if (outcome.labelings.empty() && !all_missing(problem).empty())
    throw PluginError(plugin, "gave no labelling, not even that all is missing");
  for (const Labeling& labeling : outcome.labelings) {
    if (labeling.values.size() != problem.variables.size())
      throw PluginError(plugin, "gave a labelling of " + std::to_string(labeling.values.size()) + " values for " +
                                    std::to_string(problem.variables.size()) + " variables");
    for (Index v = 0; v < labeling.values.size(); ++v)
      if (labeling.values[v] >= problem.variables[v].domain())
        throw PluginError(plugin, "gave '" + problem.variables[v].name + "' value " +
                                      std::to_string(labeling.values[v]) + " of " +
                                      std::to_string(problem.variables[v].domain()));
    if (!meets_exclusions(problem, labeling.values))
      throw PluginError(plugin, "labelled two features with candidates that share a vertex");
  }
}

void check_bound(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& plugin) {
  for (const Labeling& labeling : outcome.labelings) {
    const double cost = cost_of(problem, labeling.values);
    if (!(outcome.lower_bound <= cost) && !(outcome.lower_bound <= cost + rounding_slack(problem)))
      throw PluginError(plugin, "gave " + std::to_string(outcome.lower_bound) +
                                    " as the least that a labelling can cost, and one that costs " +
                                    std::to_string(cost));
  }
}

void check_exactness(const LabelingOutcome& outcome, const std::string& plugin) {
  if (std::isnan(outcome.log_evidence) != (outcome.evidence_exactness == Exactness::none))
    throw PluginError(plugin, "does not say whether its evidence is exact, or says it of none");
  if (outcome.posteriors.empty() != (outcome.posterior_exactness == Exactness::none))
    throw PluginError(plugin, "does not say whether its posteriors are exact, or says it of none");
}

void check_posteriors(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& plugin) {
  if (outcome.posteriors.empty()) return;
  bool sized = outcome.posteriors.size() == problem.variables.size();
  for (Index v = 0; sized && v < problem.variables.size(); ++v)
    sized = outcome.posteriors[v].size() == problem.variables[v].domain();
  if (!sized) throw PluginError(plugin, "gave posteriors that do not match the variables' domains");
  for (Index v = 0; v < problem.variables.size(); ++v) {
    double sum = 0;
    for (const double p : outcome.posteriors[v]) {
      if (!(p >= 0 && p <= 1 + posterior_rounding))
        throw PluginError(plugin, "gave a value of '" + problem.variables[v].name + "' the probability " +
                                      std::to_string(p) + ", which is not from 0 to 1");
      sum += p;
    }
    if (!(std::abs(sum - 1) <= posterior_rounding))
      throw PluginError(plugin, "gave '" + problem.variables[v].name + "' probabilities that sum to " +
                                    std::to_string(sum) + " and not to 1");
  }
}

}  // namespace

LabelingOutcome solve(const LabelerStation& labeler, const LabelingProblem& problem, const LabelingRequest& request,
                      Context& context) {
  LabelingOutcome outcome = guard(labeler.id, [&] { return labeler.plugin->solve(problem, request, context); });
  check_outcome(problem, outcome, labeler.id);
  return outcome;
}

void take_sums(LabelingOutcome& from, LabelingOutcome& to) {
  to.log_evidence = from.log_evidence;
  to.evidence_exactness = from.evidence_exactness;
  to.evidence_error = from.evidence_error;
  to.posteriors = std::move(from.posteriors);
  to.posterior_exactness = from.posterior_exactness;
  to.posterior_error = from.posterior_error;
}

void check_outcome(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& plugin) {
  check_labelings(problem, outcome, plugin);
  check_bound(problem, outcome, plugin);
  check_exactness(outcome, plugin);
  check_posteriors(problem, outcome, plugin);
}

}  // namespace toposcope
