// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/label.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pipeline/families.h"
#include "pipeline/sides.h"
#include "pipeline/solve.h"
#include "pipeline/stopwatch.h"
#include "pipeline/tell_apart.h"
#include "probability/symmetry.h"
#include "toposcope/labeling/restricted.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// Solves a class's problem for its labellings and, where the pipeline says so, again for its probabilities.
SolveTimes solve_class(ClassOutcome& posed, const ModelRun& run, const LabelingRequest& request) {
  if (has_families(run.model)) return solve_with_families(posed, run, request);
  const Stations& stations = run.stations;
  SolveTimes times;
  Stopwatch watch;
  LabelingOutcome& outcome = posed.outcome = solve(stations.labeler, posed.problem, request, run.context);
  std::string made = stations.labeler.id + ": " + outcome.guarantee;
  times.label_ms = watch.lap_ms();
  if (stations.marginals) {
    LabelingRequest sums = request;
    sums.k_best = 1;
    LabelingOutcome marginals = solve(*stations.marginals, posed.problem, sums, run.context);
    take_sums(marginals, outcome);
    made = stations.marginals->id + ": " + marginals.guarantee;
    times.marginals_ms = watch.lap_ms();
  }
  // Why there are none is worth a line where they were asked for.
  const bool any = !outcome.posteriors.empty() || !std::isnan(outcome.log_evidence);
  posed.probabilities = any || stations.marginals ? made : "";
  return times;
}

/// Leaves each feature the values of its own place where it could change names with others.
void tell_apart(ClassOutcome& posed, const std::vector<std::vector<Index>>& orbits, const ConstructedFeatures& features,
                const ModelRun& run, const LabelingRequest& request) {
  const Interchange interchange{posed, orbits, features, run};
  std::vector<Index> places = own_places(interchange);
  // Instances of families have no names to tell sides by.
  if (!has_families(run.model)) posed.sides = tell_sides(posed, places, features, run);
  const std::vector<std::vector<Index>> kept = told_apart(interchange, places);
  bool changed = false;
  for (Index v = 0; v < kept.size(); ++v) changed = changed || kept[v].size() < posed.problem.variables[v].domain();
  if (!changed) return;
  if (has_families(run.model)) {
    posed.problem = restricted(posed.problem, kept);
    solve_with_families(posed, run, request);
    return;
  }
  std::size_t largest = 1;  // orbit
  for (const std::vector<Index>& orbit : orbits) largest = std::max(largest, orbit.size());
  LabelingOutcome summed = posed.outcome;
  if (!summed.posteriors.empty()) summed.posteriors = summed_over_names(interchange, places, kept);
  summed.posterior_error *= static_cast<double>(largest);
  // A labelling is as likely as all that differ from it in names alone.
  summed.log_evidence = posed.log_evidence;
  posed.problem = restricted(posed.problem, kept);
  posed.outcome = solve(run.stations.labeler, posed.problem, request, run.context);
  take_sums(summed, posed.outcome);
}

}  // namespace

ClassOutcome label_class(ClassOutcome posed, const ConstructedFeatures& features, const ModelRun& run,
                         const LabelingRequest& request) {
  const SolveTimes times = solve_class(posed, run, request);
  posed.label_ms = times.label_ms;
  posed.marginals_ms = times.marginals_ms;
  posed.nodes = posed.outcome.nodes;
  posed.lower_bound = posed.outcome.lower_bound;
  posed.least_cost = forbidden;
  for (const Labeling& labeling : posed.outcome.labelings) posed.least_cost = std::min(posed.least_cost, labeling.cost);
  posed.renamings = renamings_of(posed, run.model, run.stations);
  // What differs in names that mean the same is one explanation, not several.
  posed.log_evidence = posed.outcome.log_evidence - std::log(static_cast<double>(posed.renamings.size()));
  tell_apart(posed, orbits_of(posed.renamings), features, run, request);
  if (has_families(run.model)) posed.renamings.clear();  // of instances, once they are written out
  posed.answer = posed.outcome.labelings.front();
  return posed;
}

void complete_class(ClassOutcome& solved) {
  const Labeling& best = solved.answer;
  solved.complete = std::all_of(best.values.begin(), best.values.end(), [](Index value) { return value > 0; });
  for (const LabelingConstraint& constraint : solved.problem.constraints)
    solved.complete = solved.complete && satisfied(constraint, table_entry(solved.problem, constraint, best.values));
}

std::vector<std::optional<Index>> first_labeling(const LabelingProblem& problem, const ModelRun& run) {
  std::vector<std::optional<Index>> labelled(run.model.features.size());
  double least = std::numeric_limits<double>::infinity();
  if (has_families(run.model)) {
    const std::vector<Index> values = best_with_families(problem, run);
    for (Index f = 0; f < values.size(); ++f)
      if (values[f] > 0) labelled[f] = problem.variables[f].candidates[values[f] - 1];
    return labelled;
  }
  for (const ClassOutcome& posed : pose_classes(problem, run.model, run.stations.probability)) {
    const Labeling best = solve(run.stations.labeler, posed.problem, {}, run.context).labelings.front();
    if (!(best.cost < least)) continue;
    least = best.cost;
    std::fill(labelled.begin(), labelled.end(), std::nullopt);
    for (Index v = 0; v < best.values.size(); ++v)
      if (best.values[v] > 0) labelled[posed.features[v]] = posed.problem.variables[v].candidates[best.values[v] - 1];
  }
  return labelled;
}

}  // namespace toposcope
